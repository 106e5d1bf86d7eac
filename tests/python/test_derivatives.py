"""Directional derivatives of Bridge.fmu: as declared, and equal to finite differences of fmi2DoStep."""

import numpy as np
import pytest
from driving import H, drive
from fmpy.fmi1 import FMICallException
from fmu import FMU2Instance, Reals

FORCE = 1e4


@pytest.fixture
def bridge(r1):
    """In motion, 30 steps after the start."""
    with FMU2Instance(r1.bridge) as bridge:
        drive(bridge.initialize(), 0, 30)
        yield bridge


def step_from(bridge, state, h, force, rates):
    """All outputs after one step of h from a state."""
    inputs = Reals(bridge, bridge.fmu.names("input"))
    bridge.setFMUstate(state)
    inputs.set(force)
    if rates is not None:
        inputs.set_rates(rates)
    bridge.doStep(30 * H, h)
    return bridge.get(*bridge.fmu.names("output"))


@pytest.mark.parametrize("h", [H, 0.4 * H, 2 * H])
@pytest.mark.parametrize("interpolated", [False, True], ids=["held", "with derivatives"])
@pytest.mark.parametrize("index", [0, 7, 24])
def test_a_directional_derivative_is_the_finite_difference_of_a_step(bridge, h, interpolated, index):
    """∂(outputs at the end of a step of the size in use)/∂(inputs' value set for it); the bridge is linear."""
    fmu = bridge.fmu
    state = bridge.getFMUstate()
    inputs, outputs = fmu.names("input"), fmu.names("output")
    base = FORCE * np.cos(np.arange(len(inputs)))
    rates = 1e6 * np.sin(np.arange(len(inputs))) if interpolated else None
    change = np.zeros(len(inputs))
    change[index] = FORCE
    difference = (step_from(bridge, state, h, base + change, rates) - step_from(bridge, state, h, base, rates)) / FORCE
    derivative = np.array(bridge.getDirectionalDerivative(fmu.references(outputs), fmu.references([inputs[index]]), [1.0]))
    for kind in (".displacement", ".velocity", ".acceleration", ".moment"):
        of_kind = [i for i, name in enumerate(outputs) if name.endswith(kind)]
        assert of_kind
        assert derivative[of_kind] == pytest.approx(difference[of_kind], rel=1e-6, abs=1e-7 * np.abs(difference[of_kind]).max())


def test_a_derivative_is_linear_in_its_direction(bridge):
    """Along a seed over all inputs: the sum over single ones."""
    fmu = bridge.fmu
    unknown, known = fmu.references(fmu.names("output")), fmu.references(fmu.names("input"))
    seed = np.sin(np.arange(len(known)))
    whole = np.array(bridge.getDirectionalDerivative(unknown, known, seed))
    parts = sum(s * np.array(bridge.getDirectionalDerivative(unknown, [k], [1.0])) for s, k in zip(seed, known))
    assert whole == pytest.approx(parts, rel=1e-9, abs=1e-12 * np.abs(whole).max())


def test_displacement_by_force_is_symmetric_and_positive(bridge):
    """docs/guide/fmus.md: force is work-conjugate to the motion; S_ii > 0, of the size h²/4m of a Newmark step."""
    fmu = bridge.fmu
    unknown = fmu.references([name for name in fmu.names("output") if name.startswith("support") and name.endswith("displacement")])
    known = fmu.references(fmu.names("input"))
    matrix = np.array([bridge.getDirectionalDerivative(unknown, [k], [1.0]) for k in known])
    assert np.abs(matrix - matrix.T).max() < 1e-9 * np.abs(matrix).max()
    assert np.linalg.eigvalsh(matrix).min() > 0


def test_asking_changes_nothing(bridge):
    """A derivative between two steps leaves no trace."""
    fmu = bridge.fmu
    state = bridge.getFMUstate()
    expected = drive(bridge, 30, 10)
    bridge.setFMUstate(state)
    bridge.getDirectionalDerivative(fmu.references(fmu.names("output")), fmu.references(fmu.names("input")[:1]), [1.0])
    assert np.array_equal(drive(bridge, 30, 10), expected)


def test_wrong_questions_are_refused(bridge, r1):
    """With respect to an output, of an input, or of the FMU that provides none."""
    fmu = bridge.fmu
    one_input, one_output = fmu.references(fmu.names("input")[:1]), fmu.references(fmu.names("output")[:1])
    with FMU2Instance(r1.train_track) as train_track:
        train_track.initialize()
        force = train_track.fmu.references(["support[1].force"])
        motion = train_track.fmu.references(["support[1].displacement"])
        for instance, unknown, known in [(bridge, one_input, one_input), (bridge, one_output, one_output), (train_track, force, motion)]:
            with pytest.raises(FMICallException):
                instance.getDirectionalDerivative(unknown, known, [1.0])
            assert instance.messages
