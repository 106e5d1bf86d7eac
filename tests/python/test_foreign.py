"""Third-party bridges, by PythonFMU (foreign/pybridge.py) and in C (foreign/beam.c), against Bridge.fmu of the same beam."""

import ctypes.util
import json
import os
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest
from fmpy.util import read_csv
from foreign_fmu import Beam
from scenario import changed

HERE = Path(__file__).parent
AT = 0.65 * np.arange(1, 50)  # the supports on R1's span
WHEEL, RAIL, CAR = "wheel[1].contact_force", "wheel[2].rail_displacement", "car[1].acceleration"


def errors(found, expected):
    """Of the wheel's force, of the rail, of the car: relative to their peaks."""
    return [np.abs(found[name] - expected[name]).max() / np.abs(expected[name]).max() for name in (WHEEL, RAIL, CAR)]


@pytest.fixture(scope="session")
def reference(ttb, examples, tmp_path_factory):
    """Scenario and results of R1 with a deck of so many kg/m (EI alike) at a step h, through Bridge.fmu; computed once."""
    done = {}

    def run(mass, h):
        if (mass, h) not in done:
            folder = tmp_path_factory.mktemp("reference")
            [span] = json.loads((examples / "r1.json").read_text())["bridge"]["structure"]["spans"]
            span = {**span, "mass": mass, "bending_stiffness": span["bending_stiffness"] * mass / 29720}
            scenario = changed(examples / "r1.json", folder / "scenario.json", {"bridge.structure.spans": [span], "time.step": h, "coupling.tolerance": 1e-8})
            ttb("run", scenario, "-o", folder, "--quiet")
            done[mass, h] = scenario, read_csv(folder / "results.csv"), json.loads((folder / "summary.json").read_text())
        return done[mass, h]

    return run


def beam(mass, **more):
    return Beam(32.5, 4.39668e11 * mass / 29720, mass, 0.05, **{"points": AT, **more})


# All that their description says is found by itself: kN, mm; that up is positive must be said.
MAP = {
    "force": {"name": "f[{i}]", "first": 0, "factor": -1e-3},
    "displacement": {"name": "w_{i}", "factor": -1e3},
    "velocity": {"name": "speed_{i}", "factor": -1},
}


def coupled(ttb, scenario, bridge, map, folder, *more, expect=0):
    """Results, summary and what was said."""
    (folder / "map.json").write_text(json.dumps(map))
    done = ttb("run", scenario, "--bridge", bridge, "--map", folder / "map.json", "-o", folder / "out", "--quiet", *more, expect=expect)
    return read_csv(folder / "out" / "results.csv"), json.loads((folder / "out" / "summary.json").read_text()), done.stderr


@pytest.mark.parametrize("mass, h", [(29720, 1e-3), (1000, 1e-3), (1000, 2e-3), (500, 5e-3)])
def test_a_small_c_fmu_gives_the_answer_of_ours(ttb, reference, tmp_path, mass, h):
    """Other names, up-positive, mm and kN, held inputs, no derivatives. Sine waves for 50 elements: that
    is the difference, 2.4e-6 on the lightest and most coarsely stepped one, 2e-8 on R1."""
    scenario, expected, summary = reference(mass, h)
    found, theirs, _ = coupled(ttb, scenario, beam(mass).write(tmp_path), MAP, tmp_path)
    assert max(errors(found, expected)) < (5e-6 if mass < 1000 else 1e-6)
    assert theirs["iterations"]["mean"] <= summary["iterations"]["mean"] + 0.5


@pytest.mark.parametrize("substeps", [1, 20])
@pytest.mark.parametrize("mass", [29720, 1000])
def test_velocities_from_displacements_cost_next_to_nothing(ttb, reference, tmp_path, mass, substeps):
    """The trapezoidal rule gives back what a bridge that integrates by it has; finer steps inside make a tenth more error."""
    scenario, expected, _ = reference(mass, 1e-3)
    both = []
    for velocities in (True, False):
        folder = tmp_path / str(velocities)
        folder.mkdir()
        map = {**MAP, **({} if velocities else {"velocity": None})}
        bridge = beam(mass, substeps=substeps, velocities=velocities).write(folder)
        found, _, said = coupled(ttb, scenario, bridge, map, folder)
        assert ("gives no velocities" in said) == (not velocities)
        both.append(np.array(errors(found, expected)))
    given, derived = both
    assert np.all(derived < 1.2 * given) if substeps > 1 else np.all(derived < 2e-6)
    assert np.all(given < (1e-3 if substeps > 1 else 2e-6))


# Error of wheel force by stations and interpolation, R1: a bound each, and that cubics are worth it.
STATIONS = {(9, "linear"): 2e-3, (9, "cubic"): 3e-4, (19, "linear"): 5e-4, (19, "cubic"): 4e-5, (99, "linear"): 2e-6, (99, "cubic"): 2e-6}


@pytest.mark.parametrize("count, shape", STATIONS)
def test_other_stations_are_interpolated(ttb, reference, tmp_path, count, shape):
    """Read from the FMU's own outputs; it has none at its bearings, which the map names."""
    scenario, expected, _ = reference(29720, 1e-3)
    points = np.linspace(0.0, 32.5, count + 2)[1:-1]
    more = {"stations": {"name": "x{i}"}, "bearings": [0.0, 32.5], "interpolation": shape}
    found, _, _ = coupled(ttb, scenario, beam(29720, points=points).write(tmp_path), {**MAP, **more}, tmp_path)
    assert errors(found, expected)[0] < STATIONS[count, shape]


def test_stations_without_bearings_would_lose_force(ttb, reference, tmp_path):
    """Refused before anything runs."""
    scenario, _, _ = reference(29720, 1e-3)
    bridge = beam(29720, points=np.linspace(0.0, 32.5, 11)[1:-1]).write(tmp_path)
    (tmp_path / "map.json").write_text(json.dumps({**MAP, "stations": {"name": "x{i}"}}))
    said = ttb("run", scenario, "--bridge", bridge, "--map", tmp_path / "map.json", "-o", tmp_path / "out", expect=2).stderr
    assert "8 supports stand outside its stations, which reach from 3.25 m to 29.25 m" in said and "bearings" in said


def test_stations_without_velocities_and_without_roll_back(ttb, reference, tmp_path):
    """All that can be missing at once: the estimate bounds the rail's error beyond the interpolation's."""
    scenario, expected, _ = reference(29720, 1e-3)
    points = np.linspace(0.0, 32.5, 101)[1:-1]
    map = {**MAP, "velocity": None, "stations": {"name": "x{i}"}, "bearings": [0.0, 32.5]}
    bridge = beam(29720, points=points, velocities=False, roll_back=False).write(tmp_path)
    found, summary, _ = coupled(ttb, scenario, bridge, map, tmp_path)
    assert 0 < errors(found, expected)[1] < summary["coupling"]["error_estimate"] < 1e-4


@pytest.mark.parametrize("mass, h, code", [(29720, 1e-3, 0), (1000, 1e-3, 0), (500, 5e-3, 3)])
def test_without_roll_back_a_bound_or_a_refusal(ttb, reference, tmp_path, mass, h, code):
    """The largest residual bounds the error of the rail; a light bridge is refused before its first step."""
    scenario, expected, _ = reference(mass, h)
    bridge = beam(mass, roll_back=False).write(tmp_path)
    found, summary, said = coupled(ttb, scenario, bridge, MAP, tmp_path, expect=code)
    if code == 0:
        assert 0 < errors(found, expected)[1] < summary["coupling"]["error_estimate"]
    else:
        assert "is not stable: ρ = " in said and summary["reached_s"] == 0


def test_roll_back_can_be_declined(ttb, reference, tmp_path):
    """For FMUs whose states fail late."""
    scenario, expected, _ = reference(29720, 1e-3)
    found, summary, said = coupled(ttb, scenario, beam(29720).write(tmp_path), {**MAP, "roll_back": False}, tmp_path)
    assert "is not rolled back" in said and summary["coupling"]["method"] == "explicit"
    assert 0 < errors(found, expected)[1] < summary["coupling"]["error_estimate"]


def test_parameters_make_another_bridge_of_it(ttb, reference, tmp_path):
    """The FMU of a heavy deck, told to be a light one."""
    scenario, expected, _ = reference(1000, 1e-3)
    more = {"parameters": {"Deck.EI": 4.39668e11 * 1000 / 29720, "Deck.mu": 1000}}
    found, _, _ = coupled(ttb, scenario, beam(29720).write(tmp_path), {**MAP, **more}, tmp_path)
    assert max(errors(found, expected)) < 2e-6


def libpython():
    """The shared library of this Python; PythonFMU's FMUs want it."""
    here = Path(sysconfig.get_config_var("LIBDIR") or "") / (sysconfig.get_config_var("INSTSONAME") or "none")
    found = here if here.is_file() else ctypes.util.find_library(f"python{sys.version_info.major}.{sys.version_info.minor}")
    return str(found) if found else None


needs_libpython = pytest.mark.skipif(libpython() is None, reason="this Python has no shared library")


@pytest.fixture(scope="session")
def python_bridge(tmp_path_factory):
    """The FMU of foreign/pybridge.py, with and without its own state hooks, as PythonFMU builds it."""

    def build(hooks, saves=True):
        folder = tmp_path_factory.mktemp("pythonfmu")
        source = (HERE / "foreign" / "pybridge.py").read_text()
        (folder / "pybridge.py").write_text(source if hooks else source.replace("0.05, True", "0.05, False"))
        flags = ["--no-external-tool"] + (["--handle-state"] if saves else [])
        command = [sys.executable, "-m", "pythonfmu", "build", "-f", folder / "pybridge.py", "-d", folder, *flags]
        subprocess.run(command, check=True, capture_output=True, cwd=folder)
        return folder / "PyBridge.fmu"

    return build


PYTHON_MAP = {"force": {"name": "F{i}"}, "displacement": {"name": "u{i}"}, "velocity": {"name": "v{i}"}}


@pytest.fixture
def python_path(monkeypatch):
    """Where the embedded Python finds NumPy, one thread for it."""
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path[1:]))
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")


@needs_libpython
@pytest.mark.parametrize("isolate", [[], ["--isolate"]], ids=["in-process", "isolated"])
def test_a_python_fmu_with_state_hooks_gives_the_answer_of_ours(ttb, reference, tmp_path, python_bridge, python_path, isolate):
    """The same 50 elements, the same rule; the iteration's tolerance is 1e-8."""
    scenario, expected, _ = reference(29720, 1e-3)
    found, summary, _ = coupled(ttb, scenario, python_bridge(True), PYTHON_MAP, tmp_path, "--preload", libpython(), *isolate)
    assert max(errors(found, expected)) < 1e-7
    assert summary["iterations"]["not_converged"] == 0 and summary["coupling"]["probe"]["bridge_repeats_to"] == [0.0]


@needs_libpython
def test_a_python_fmu_without_hooks_is_found_out(ttb, reference, tmp_path, python_bridge, python_path):
    """PythonFMU saves declared variables only; the deck's motion inside is none. Run without roll-back, with a bound."""
    scenario, expected, _ = reference(29720, 1e-3)
    found, summary, said = coupled(ttb, scenario, python_bridge(False), PYTHON_MAP, tmp_path, "--preload", libpython())
    assert "a step repeated from a restored state differs" in said
    assert 0 < errors(found, expected)[1] < summary["coupling"]["error_estimate"] < 1e-4


@needs_libpython
def test_a_python_fmu_that_saves_nothing_steps_once(ttb, reference, tmp_path, python_bridge, python_path):
    """Built without --handle-state."""
    scenario, expected, _ = reference(29720, 1e-3)
    bridge = python_bridge(True, saves=False)
    found, summary, said = coupled(ttb, scenario, bridge, PYTHON_MAP, tmp_path, "--preload", libpython())
    assert "cannot save and restore its state" in said
    assert 0 < errors(found, expected)[1] < summary["coupling"]["error_estimate"] < 1e-4


@needs_libpython
def test_without_preload_the_message_names_it(ttb, reference, tmp_path, python_bridge):
    scenario, _, _ = reference(29720, 1e-3)
    (tmp_path / "map.json").write_text(json.dumps(PYTHON_MAP))
    arguments = ["run", scenario, "--bridge", python_bridge(True), "--map", tmp_path / "map.json", "-o", tmp_path / "out"]
    assert "--preload libpython" in ttb(*arguments, expect=4).stderr
    assert "--preload: " in ttb(*arguments, "--preload", "libnowhere.so", expect=2).stderr
