"""The wheel in a Python for Windows, and both FMUs in other people's importers there: under Wine."""

import json
import math
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from conftest import EXAMPLES, HOSTS, REPOSITORY, only
from windows import assert_same, mingw, needs_wine, type_ctrl_c

pytestmark = needs_wine
PINNED = Path(__file__).with_name("windows.txt")
# Where this Python looks for modules; a file of its own that replaces all other rules.
PATHS = "python313.zip\n.\nLib\\site-packages\nimport site\n"


@pytest.fixture(scope="session")
def packages():
    """What windows.txt names, in a folder that stays: target/windows-python."""
    place = (REPOSITORY / "target/windows-python").absolute()
    stamp = place / "stamp"
    if not stamp.is_file() or stamp.read_bytes() != PINNED.read_bytes():
        shutil.rmtree(place, ignore_errors=True)
        command = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--require-hashes", "--no-deps"]
        command += ["--platform=win_amd64", "--python-version=3.13", "--target", place, "--requirement", PINNED]
        if subprocess.run(command, capture_output=True, timeout=600).returncode != 0:
            pytest.skip("a Python for Windows cannot be had")
        # Wine 8 lacks what it calls; Python does without.
        (place / "_wmi.pyd").unlink()
        (place / "python313._pth").write_text(PATHS)
        stamp.write_bytes(PINNED.read_bytes())
    return place


@pytest.fixture(scope="session")
def place(packages, wine, dist, tmp_path_factory):
    """The folder of a Python into which pip, there, has installed the wheel."""
    place = tmp_path_factory.mktemp("Python 3")
    shutil.copytree(packages, place, dirs_exist_ok=True)
    pip = Path(find_spec("pip").origin).parent
    options = ["--no-index", "--no-deps", "--no-cache-dir", "--disable-pip-version-check", "--no-warn-script-location"]
    wine(place / "python.exe", pip, "install", *options, f"Z:{only(dist, '*win_amd64.whl')}")
    for folder in (place, place / "Scripts"):
        mingw(folder / "bcryptprimitives.dll", "bcryptprimitives.c", "-shared", "-ladvapi32")
    return place


def python(wine, place, code, *arguments):
    """What a program in Python prints."""
    return wine(place / "python.exe", "-c", code, *arguments, cwd=place.parent).stdout


def test_a_run_has_the_results_of_linux(wine, place, r1, tmp_path):
    """`import ttb` finds the program where pip has put it; columns, peaks."""
    code = """import sys, ttb
result = ttb.run(sys.argv[1], output=sys.argv[2])
print(result.summary["status"], len(result.columns()["time"]), float(result.peaks["point[mid].acceleration"]))"""
    status, rows, peak = python(wine, place, code, EXAMPLES / "r1.json", tmp_path).split()
    assert (status, rows) == ("ok", "1101")
    expected = json.loads((r1 / "summary.json").read_text())["peaks"]["point[mid].acceleration"]
    assert math.isclose(float(peak), max(-expected["min"]["value"], expected["max"]["value"]), rel_tol=1e-6)
    assert_same(tmp_path / "results.csv", r1 / "results.csv")


def test_all_problems_are_told(wine, place):
    """As on Linux."""
    code = """import ttb
try:
    ttb.check(None, {"train.speed.km_h": -1, "bridge.dampng": 0})
except ttb.Problems as found:
    print(*sorted(problem.path for problem in found.problems), sep="\\n")"""
    assert python(wine, place, code).splitlines() == ["$.train.speed.km_h", "--set bridge.dampng"]


# CALL FOLDER RESULTS...: interrupts itself, as notebooks do on Windows, once all RESULTS have rows.
INTERRUPTED = """
import _thread, os, sys, threading, time, ttb
call, output, *results = sys.argv[1:]

def interrupt():
    while not all(os.path.isfile(path) and os.path.getsize(path) > 100_000 for path in results):
        time.sleep(0.05)
    _thread.interrupt_main()

if results:
    threading.Thread(target=interrupt, daemon=True).start()
try:
    eval(call)
except KeyboardInterrupt:
    sys.exit(130)
"""
SWEEP = "ttb.sweep(None, {'irregularity.seed': [1, 2, 3]}, workers=2, output=output)"


@pytest.mark.parametrize("call, runs", [("ttb.run(output=output)", ["."]), (SWEEP, ["0001", "0002"])], ids=["run", "sweep"])
def test_an_interrupted_call_keeps_the_results_so_far(call, runs, wine, place, tmp_path):
    """Without a console; a sweep begins no other run."""
    results = [f"Z:{tmp_path / run / 'results.csv'}" for run in runs]
    wine(place / "python.exe", "-c", INTERRUPTED, call, f"Z:{tmp_path}", *results, expect=130, timeout=100)
    assert_interrupted(*(tmp_path / run for run in runs))
    assert not (tmp_path / "0003").exists()


def test_ctrl_c_in_a_console_keeps_them_too(wine, place, tmp_path):
    """Python and the program both hear it."""
    command = [place / "python.exe", "-c", INTERRUPTED, "ttb.run(output=output)", f"Z:{tmp_path}"]
    assert type_ctrl_c(wine, tmp_path / "results.csv", *command) == 130
    assert_interrupted(tmp_path)


def assert_interrupted(*folders):
    for folder in folders:
        summary = json.loads((folder / "summary.json").read_text())
        assert summary["status"] == "interrupted" and 0 < summary["reached_s"] < 8.064


def test_fmpy_and_ecos_for_windows_find_what_they_find_on_linux(wine, place, fmus, tmp_path):
    """Each FMU alone in FMPy, which validates it, and the pair in ecos."""
    script, folder = HOSTS / "importers.py", fmus["Bridge"].path.parent
    expected = subprocess.run([sys.executable, script, folder], check=True, capture_output=True, text=True, timeout=120).stdout
    mingw(tmp_path / "tar.exe", "tar.c")
    wine.environment["TTB_PYTHON"] = f"Z:{place / 'python.exe'}"
    found = wine(place / "python.exe", script, f"Z:{folder}", cwd=tmp_path).stdout
    found, expected = (json.loads(text.splitlines()[-1]) for text in (found, expected))
    assert len(found) == 4 and all(math.isclose(a, b, rel_tol=1e-9) for a, b in zip(found, expected, strict=True)), (found, expected)
