"""The examples: all are free of problems, and R1 gives the published numbers (docs/theory.md 15, two independent codes)."""

import json
import shutil

import pytest
from conftest import REPOSITORY
from scenario import changed

EXAMPLES = sorted((REPOSITORY / "examples").glob("*.json"))

# example, step, s: peak mid mm; acceleration at mid +/−, of the car body +/−, m/s²; contact force of wheel 1 min/max, kN.
ROWS = [
    ("r1-smooth", 5e-5, 0.65260, (0.08423, -0.09196), (0.00802, -0.01176), (141.305, 144.596)),
    ("r1", 5e-5, 0.65229, (0.12792, -0.17493), (0.11804, -0.10921), (109.728, 176.012)),
    ("r1", 1e-3, 0.65235, (0.12999, -0.17649), (0.11819, -0.10934), (109.188, 176.842)),
    ("r1-linear", 5e-5, 0.65229, (0.12819, -0.17521), (0.11805, -0.10919), (109.668, 176.015)),
]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_has_no_problems(ttb, example):
    """`ttb check-scenario`."""
    assert "no problems" in ttb("check-scenario", example).stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_for_a_while(ttb, example, tmp_path):
    """Its first 20 steps, copied beside the files that it names."""
    for file in example.parent.glob("*.csv"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    shutil.copytree(example.parent / "bridges", tmp_path / "bridges")
    step = json.loads(example.read_text()).get("time", {"step": 1e-3})["step"]
    ttb("run", changed(example, tmp_path / "s.json", {"time.end": 20 * step}), "-o", tmp_path / "out")
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["iterations"]["steps"] == 20


def test_the_bundled_scenario_is_the_default_example(ttb, examples, default, tmp_path):
    """`ttb run` without a scenario."""
    ttb("build", examples / "default.json", "-o", tmp_path)
    for fmu in (default.train_track, default.bridge):
        assert (tmp_path / fmu.path.name).read_bytes() == fmu.path.read_bytes()


@pytest.mark.parametrize("example, step, displacement, acceleration, car, force", ROWS, ids=lambda value: str(value))
def test_r1_gives_the_published_peaks(ttb, examples, tmp_path, example, step, displacement, acceleration, car, force):
    """Within 0.2 % (displacement), 1 % (force), 3 % (acceleration) at the same step."""
    scenario = changed(examples / f"{example}.json", tmp_path / "s.json", {"time.step": step, "output": {"every": 1000, "peaks_from": "start"}})
    ttb("run", scenario, "-o", tmp_path)
    peaks = json.loads((tmp_path / "summary.json").read_text())["peaks"]

    def extremes(name, *kinds):
        return tuple(peaks[name][kind]["value"] for kind in kinds)

    assert 1e3 * peaks["point[mid].displacement"]["max"]["value"] == pytest.approx(displacement, rel=0.002)
    assert extremes("point[mid].acceleration", "max", "min") == pytest.approx(acceleration, rel=0.03)
    assert extremes("car[1].acceleration", "max", "min") == pytest.approx(car, rel=0.03)
    assert extremes("wheel[1].contact_force", "min", "max") == pytest.approx(tuple(1e3 * f for f in force), rel=0.01)
