"""How steps arrive from real importers (docs/guide/fmus.md): with rounding in their size, as crumbs, from other start times."""

import numpy as np
import pytest
from driving import H, drive
from fmpy.fmi1 import FMICallException
from fmu import FMU2Instance


def outputs(instance):
    """All outputs."""
    return instance.get(*instance.fmu.names("output"))


def test_a_crumb_of_a_step_succeeds_and_changes_nothing(fmu):
    """OMSimulator ends with h = 1.4e-17."""
    with FMU2Instance(fmu) as instance:
        drive(instance.initialize(), 0, 20)
        before = outputs(instance)
        for crumb in [1.4e-17, 0.0, 1e-13]:
            instance.doStep(20 * H, crumb)
            assert np.array_equal(outputs(instance), before)


def test_a_step_that_does_not_begin_where_the_last_one_ended_is_refused(fmu):
    """However small it is; with both times in the message."""
    for t, size in [(1e3, 1e-10), (21 * H, H), (0.0, H)]:
        with FMU2Instance(fmu) as instance:
            drive(instance.initialize(), 0, 20)
            with pytest.raises(FMICallException):
                instance.doStep(t, size)


@pytest.mark.parametrize("size", [0.0009999999999999998, 0.0010000000000000002, 0.001 * (1 + 1e-12)])
def test_a_step_with_rounding_in_its_size_is_the_nominal_one(fmu, size):
    """t is summed up by some importers, and h is a difference of such sums: the same motion."""
    with FMU2Instance(fmu) as instance, FMU2Instance(fmu) as rounded:
        expected = drive(instance.initialize(), 0, 50)
        difference = np.abs(drive(rounded.initialize(), 0, 50, h=size) - expected).max(axis=0)
        assert (difference <= 1e-9 * np.abs(expected).max(axis=0)).all()


def test_a_run_may_start_at_another_time(r1):
    """The train is where it is at the start time given to fmi2SetupExperiment, not at t = 0."""
    with FMU2Instance(r1.train_track) as early, FMU2Instance(r1.train_track) as late:
        early.initialize()
        late.setupExperiment(startTime=100.0)
        late.enterInitializationMode()
        late.exitInitializationMode()
        for n in range(100):
            early.doStep(n * H, H)
            late.doStep(100.0 + n * H, H)
        assert outputs(late) == pytest.approx(outputs(early), rel=1e-6, abs=1e-6)


def test_equal_steps_may_be_divided_differently(r1):
    """canHandleVariableCommunicationStepSize: one step of 4 ms is four of 1 ms under forces on a straight line."""
    name = "support[20].force"
    reference = r1.bridge.references([name])
    with FMU2Instance(r1.bridge) as whole, FMU2Instance(r1.bridge) as parts:
        whole.initialize()
        parts.initialize()
        whole.setRealInputDerivatives(reference, [1], [1e6])
        whole.doStep(0.0, 4 * H)
        for n in range(4):
            parts.set({name: 1e6 * n * H})
            parts.setRealInputDerivatives(reference, [1], [1e6])
            parts.doStep(n * H, H)
        assert outputs(whole) == pytest.approx(outputs(parts), rel=1e-9, abs=1e-15)
