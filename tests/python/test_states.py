"""Instances and their states: saved, restored, serialized, reset, many at once. Always bit for bit."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from driving import H, drive
from fmpy.fmi1 import FMICallException
from fmu import FMU2Instance, Reals


def test_a_restored_state_repeats_the_steps(fmu):
    """Architecture, invariant 3: contact and history included."""
    with FMU2Instance(fmu) as instance:
        instance.initialize()
        drive(instance, 0, 100)
        state = instance.getFMUstate()
        first = drive(instance, 100, 50)
        for _ in range(2):
            instance.setFMUstate(state)
            assert np.array_equal(drive(instance, 100, 50), first)
        assert np.abs(np.diff(first, axis=0)).max() > 0
        instance.freeFMUstate(state)


def test_a_state_holds_inputs_and_derivatives_too(fmu):
    """docs/guide/fmus.md: what was set before saving is set after restoring, also the derivatives for the coming step."""
    with FMU2Instance(fmu) as instance:
        instance.initialize()
        inputs, outputs = Reals(instance, fmu.names("input")), Reals(instance, fmu.names("output"))
        inputs.set(np.full(inputs.size, 1e-3))
        inputs.set_rates(np.full(inputs.size, 2.0))
        state = instance.getFMUstate()
        instance.doStep(0.0, H)
        first = outputs.get()
        inputs.set(np.zeros(inputs.size))
        instance.setFMUstate(state)
        assert (inputs.get() == 1e-3).all()
        instance.doStep(0.0, H)
        assert np.array_equal(outputs.get(), first)


def test_a_state_also_brings_back_the_moment_before_initialization(fmu):
    """A state saved at instantiation leads to the same run as a fresh instance."""
    with FMU2Instance(fmu) as instance:
        state = instance.getFMUstate()
        instance.initialize()
        first = drive(instance, 0, 20)
        instance.setFMUstate(state)
        instance.initialize()
        assert np.array_equal(drive(instance, 0, 20), first)


def test_a_serialized_state_continues_in_another_instance(fmu):
    """Bytes → state → the same bytes, the same steps; also with parameters other than the defaults."""
    parameter = {"TrainTrack": "speed", "Bridge": "stiffness_factor"}[fmu.identifier]
    with FMU2Instance(fmu) as one, FMU2Instance(fmu) as other:
        one.initialize(**{parameter: 50.0})
        drive(one, 0, 60)
        saved = one.serializeFMUstate(one.getFMUstate())
        expected = drive(one, 60, 40)
        state = other.deSerializeFMUstate(saved)
        assert other.serializeFMUstate(state) == saved
        other.setFMUstate(state)
        assert other.get(parameter) == 50.0
        assert np.array_equal(drive(other, 60, 40), expected)


def test_bytes_that_are_no_state_are_refused(fmu, r1):
    """Cut off, altered at the head, or of the other FMU: an error with a message, and the instance goes on."""
    stranger = r1.bridge if fmu is r1.train_track else r1.train_track
    with FMU2Instance(fmu) as instance, FMU2Instance(stranger) as other:
        instance.initialize()
        saved = instance.serializeFMUstate(instance.getFMUstate())
        foreign = other.serializeFMUstate(other.getFMUstate())
        for wrong in (saved[:-1], saved[:40], b"", b"x" + saved[1:], saved + b"\0", foreign):
            with pytest.raises(FMICallException):
                instance.deSerializeFMUstate(wrong)
            assert "serialized FMU state" in instance.messages[-1][3]
        instance.doStep(0.0, H)


def test_a_state_is_overwritten_freed_and_then_unknown(fmu):
    """docs/guide/fmus.md: overwrite when not NULL; Free sets NULL and accepts NULL."""
    with FMU2Instance(fmu) as instance:
        instance.initialize()
        state = instance.getFMUstate()
        handle = state.value
        drive(instance, 0, 5)
        instance.fmi2GetFMUstate(instance.component, state)
        assert state.value == handle
        later = drive(instance, 5, 5)
        instance.setFMUstate(state)
        assert np.array_equal(drive(instance, 5, 5), later)
        instance.freeFMUstate(state)
        assert state.value is None
        instance.freeFMUstate(state)
        with pytest.raises(FMICallException):
            instance.setFMUstate(type(state)(handle))


def test_after_reset_the_run_is_the_same(fmu):
    """docs/guide/fmus.md: also with other parameters in between, and from a terminated instance."""
    with FMU2Instance(fmu) as instance:
        first = drive(instance.initialize(), 0, 50)
        instance.reset()
        instance.initialize(step_size=0.5e-3)
        drive(instance, 0, 5)
        instance.terminate()
        instance.reset()
        assert np.array_equal(drive(instance.initialize(), 0, 50), first)


def test_instances_in_threads_do_not_disturb_each_other(fmu):
    """Architecture, invariant 10: eight instances in four threads, all as one alone."""

    def run(number):
        with FMU2Instance(fmu, name=f"number {number}") as instance:
            return drive(instance.initialize(), 0, 100)

    alone = run(0)
    with ThreadPoolExecutor(4) as threads:
        assert all(np.array_equal(result, alone) for result in threads.map(run, range(8)))
