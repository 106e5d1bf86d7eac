"""What an input means over a step (docs/guide/fmus.md): each way of telling the same motion or force leads to the same run."""

import numpy as np
import pytest
from fmu import FMU2Instance, Reals

H, STEPS = 1e-3, 60
EXTRAPOLATE, MEAN, END = 1, 2, 3


def path(count, n, size):
    """A smooth vector at t_n."""
    return size * np.sin(0.05 * n + np.arange(count)) * (1 - np.cos(0.02 * n))


def run(fmu, names, size, tell, meaning=None):
    """All outputs after every step; `tell` sets the inputs of a step from their values at its begin and end."""
    with FMU2Instance(fmu) as instance:
        if meaning is not None:
            instance.setInteger(fmu.references(["input_meaning"]), [meaning])
        instance.initialize()
        inputs, outputs = Reals(instance, names), Reals(instance, fmu.names("output"))
        rows = []
        for n in range(STEPS):
            tell(inputs, path(inputs.size, n, size), path(inputs.size, n + 1, size))
            instance.doStep(n * H, H)
            rows.append(outputs.get())
        return np.array(rows)


def with_derivatives(inputs, begin, end):
    inputs.set(begin)
    inputs.set_rates((end - begin) / H)


def the_mean(inputs, begin, end):
    inputs.set(0.5 * (begin + end))


def the_end(inputs, begin, end):
    inputs.set(end)


def begin_and_velocity(inputs, begin, end):
    """Displacement at t_n and the velocity that leads to t_n + h; only displacements and velocities that fit."""
    half = inputs.size // 2
    inputs.set(np.concatenate([begin[:half], (end - begin)[:half] / H]))


def close(rows, expected):
    """Equal up to rounding, column by column."""
    return (np.abs(rows - expected).max(axis=0) <= 1e-7 * np.abs(expected).max(axis=0)).all()


@pytest.mark.parametrize("tell, meaning", [(the_mean, MEAN), (the_end, END), (with_derivatives, MEAN), (with_derivatives, END)])
def test_the_deck_may_be_told_as_mean_or_end_value(r1, tell, meaning):
    """Held inputs of TrainTrack.fmu by `input_meaning`; derivatives, where set, always win."""
    fmu = r1.train_track
    expected = run(fmu, fmu.names("input"), 1e-3, with_derivatives)
    assert np.abs(expected).max() > 0
    assert close(run(fmu, fmu.names("input"), 1e-3, tell, meaning), expected)


def test_by_default_the_deck_runs_on_with_its_velocity(r1):
    """`extrapolate`: a held displacement moves on with the velocity input, which itself is held."""
    fmu = r1.train_track
    names = fmu.names("input")
    half = len(names) // 2

    def with_rates(inputs, begin, end):
        velocity = (end - begin)[:half] / H
        inputs.set(np.concatenate([begin[:half], velocity]))
        inputs.set_rates(np.concatenate([velocity, np.zeros(half)]))

    expected = run(fmu, names, 1e-3, with_rates)
    assert close(run(fmu, names, 1e-3, begin_and_velocity), expected)
    assert close(run(fmu, names, 1e-3, begin_and_velocity, EXTRAPOLATE), expected)


def test_a_held_force_on_the_bridge_is_the_mean_over_the_step(r1):
    """Bridge.fmu: displacement and velocity are those under the straight line with that mean."""
    fmu = r1.bridge
    motion = [i for i, name in enumerate(fmu.names("output")) if name.endswith((".displacement", ".velocity"))]
    rows = [run(fmu, fmu.names("input"), 1e5, tell)[:, motion] for tell in (the_mean, with_derivatives)]
    assert close(*rows)


def test_a_held_force_on_the_bridge_may_be_told_as_end_value(r1):
    """`input_meaning` 2 of Bridge.fmu: the straight line to it, accelerations included; derivatives, where set, win."""
    fmu = r1.bridge
    expected = run(fmu, fmu.names("input"), 1e5, with_derivatives)
    assert close(run(fmu, fmu.names("input"), 1e5, the_end, 2), expected)
    assert close(run(fmu, fmu.names("input"), 1e5, with_derivatives, 2), expected)
    assert not close(run(fmu, fmu.names("input"), 1e5, the_end, 1), expected)


def test_the_mean_force_is_the_mean_of_begin_and_end(r1):
    """`support[i].mean_force` over a step that is not divided."""
    fmu = r1.train_track
    names = fmu.names("output")
    rows = run(fmu, fmu.names("input"), 1e-3, with_derivatives)
    force = rows[:, names.index("support[20].force")]
    mean = rows[:, names.index("support[20].mean_force")]
    assert mean[1:] == pytest.approx((force[1:] + force[:-1]) / 2, rel=1e-9)
