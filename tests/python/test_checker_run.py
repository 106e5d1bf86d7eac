"""What the FMU Compliance Checker does with a co-simulation FMU: its whole life, every message noted, none expected."""

import subprocess
import sys
from pathlib import Path

import numpy as np
from fmpy import simulate_fmu
from fmpy.fmi2 import fmi2OK
from fmu import FMU2Instance

STEPS = 200


def test_a_whole_life_with_debug_logging_brings_milestones_only(any_fmu):
    """fmuCheck: platform, version, start values, default experiment; an error or warning would be a finding."""
    with FMU2Instance(any_fmu, name="checked", debug=True) as instance:
        assert (instance.getTypesPlatform(), instance.getVersion()) == ("default", "2.0")
        experiment = any_fmu.description.defaultExperiment
        step, stop = float(experiment.stepSize), float(experiment.stopTime)
        instance.initialize(stop)
        outputs = any_fmu.names("output")
        for n in range(min(STEPS, round(stop / step))):
            instance.doStep(n * step, step)
            assert np.isfinite(instance.get(*outputs)).all()
        instance.terminate()
        assert {(name, status, category) for name, status, category, _ in instance.messages} == {("checked", fmi2OK, "logEvents")}


def test_without_debug_logging_nothing_is_said(any_fmu):
    """loggingOn = false."""
    with FMU2Instance(any_fmu) as instance:
        instance.initialize()
        instance.doStep(0.0, 1e-3)
        assert instance.messages == []


def test_debug_logging_without_categories_means_all(any_fmu):
    """docs/guide/fmus.md: SetDebugLogging with no category; the declared categories are known, others bring a warning."""
    with FMU2Instance(any_fmu) as instance:
        instance.setDebugLogging(True, [])
        instance.reset()
        assert len(instance.messages) == 1
        instance.setDebugLogging(True, [category.name for category in any_fmu.description.logCategories])
        assert len(instance.messages) == 1
        instance.setDebugLogging(True, ["nonsense"])
        assert "nonsense" in instance.messages[-1][3]


def test_a_run_in_fmpy_prints_nothing(any_fmu, capfd):
    """No stdout, no stderr, from FMU or FMPy; validation included."""
    simulate_fmu(str(any_fmu.path), stop_time=0.05)
    assert capfd.readouterr() == ("", "")


def test_start_values_of_the_description_are_those_of_the_instance(any_fmu):
    """Before anything is set, for every type of variable."""
    with FMU2Instance(any_fmu) as instance:
        for variable in (v for v in any_fmu.description.modelVariables if v.start is not None):
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            value = getattr(instance, f"get{kind}")([variable.valueReference])[0]
            start = {"true": 1.0, "false": 0.0}.get(variable.start) if kind == "Boolean" else float(variable.start)
            assert value == start, variable.name


def test_loading_an_fmu_changes_nothing_in_the_process(r1):
    """docs/guide/fmus.md: no chdir, no signal handlers, no threads of its own; in a process of its own."""
    script = f"""
import os, signal, sys, threading
sys.path.insert(0, {str(Path(__file__).parent)!r})
from fmu import FMU2Instance, Fmu
state = lambda: (os.getcwd(), signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGSEGV), len(os.listdir('/proc/self/task')))
before = state()
for path in sys.argv[1:]:
    with FMU2Instance(Fmu(path)) as instance:
        instance.initialize()
        instance.doStep(0.0, 1e-3)
        assert state() == before, (before, state())
"""
    subprocess.run([sys.executable, "-c", script, r1.train_track.path, r1.bridge.path], check=True)
