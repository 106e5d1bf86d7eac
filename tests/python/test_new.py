"""`ttb new`: the first files of a project run as they are."""

import json

import pytest

KINDS = {
    "single-span": [],
    "viaduct": ["--spans", "24,30", "--n0", "4.2", "--mass", "9000"],
    "matrices": ["--n0", "4.5"],
    "fmu": ["--spans", "20"],
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_project_passes_its_checks_and_runs(ttb, tmp_path, kind):
    """From nothing to peaks, in two commands."""
    said = ttb("new", kind, tmp_path / "mine", *KINDS[kind], "--train", "velaro-e").stdout
    assert "next: ttb run" in said
    scenario = tmp_path / "mine" / "scenario.json"
    assert "$comment" in scenario.read_text()
    ttb("run", scenario, "-o", tmp_path / "results", "-q", "--set", "irregularity.type=none")
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    point = "mid1" if kind == "viaduct" else "mid"
    assert summary["status"] == "ok" and summary["peaks"][f"point[{point}].displacement"]["max"]["value"] > 1e-5


def test_matrices_are_those_of_the_beam(ttb, tmp_path):
    """The same span as a beam and as K and M: the same peaks."""
    peaks = {}
    for kind in ("single-span", "matrices"):
        ttb("new", kind, tmp_path / kind, "--n0", "5", "--mass", "10000", "--train", "velaro-e")
        changes = ["--set", "irregularity.type=none", "--set", "bridge.damping.at.hz=[5, 20]", "--set", "time.end=2"]
        ttb("run", tmp_path / kind / "scenario.json", "-o", tmp_path / kind / "results", "-q", *changes)
        summary = json.loads((tmp_path / kind / "results" / "summary.json").read_text())
        peaks[kind] = summary["peaks"]["point[mid].displacement"]["max"]["value"]
    assert peaks["matrices"] == pytest.approx(peaks["single-span"], rel=1e-3)


def test_nothing_is_overwritten_and_what_cannot_run_is_not_written(ttb, tmp_path):
    """Exit code 2, with all that is wrong."""
    ttb("new", "single-span", tmp_path / "a")
    assert "there already" in ttb("new", "matrices", tmp_path / "a", expect=2).stderr
    said = ttb("new", "viaduct", tmp_path / "b", "--spans", "24,0.1", "--mass", "-3", expect=2).stderr
    assert "1 to 500 m" in said and "mass must be greater than 0" in said
    said = ttb("new", "single-span", tmp_path / "c", "--train", "ice33", expect=2).stderr
    assert "ice3" in said and not (tmp_path / "b").exists() and not (tmp_path / "c").exists()
