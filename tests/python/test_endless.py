"""Parameters that would keep an FMU busy for hours are refused at once; tried in a process that can be ended."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = """
import sys
sys.path.insert(0, sys.argv[1])
from fmpy.fmi1 import FMICallException
from fmu import FMU2Instance, Fmu
with FMU2Instance(Fmu(sys.argv[2])) as instance:
    try:
        instance.initialize(**{sys.argv[3]: float(sys.argv[4])})
        instance.doStep(0.0, 1e-3)
    except FMICallException:
        print(instance.messages[-1][3])
"""


@pytest.mark.parametrize(
    "side, name, value",
    [("train_track", "step_size", 1e-12), ("train_track", "pre_roll", 1e10), ("bridge", "step_size", 1e-12)],
)
def test_a_parameter_that_asks_for_endless_work_is_refused(r1, side, name, value):
    """An impossible parameter is fmi2Error with a message that says what."""
    command = [sys.executable, "-c", SCRIPT, Path(__file__).parent, getattr(r1, side).path, name, str(value)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    assert name in done.stdout
