"""Several bridge FMUs along one track: a viaduct of independent girders against one FMU that holds them all."""

import json

import numpy as np
import pytest
from fmpy.util import read_csv
from scenario import changed
from spoil import DESCRIPTION, copy, replaced
from fmu import Fmu

WHEEL = "wheel[1].contact_force"


@pytest.fixture(scope="module")
def viaduct(ttb, examples, tmp_path_factory):
    """Two spans of R1 under one car: the scenario, one FMU of both, one of a single span."""
    folder = tmp_path_factory.mktemp("viaduct")
    scenario = json.loads((examples / "r1.json").read_text())
    [span] = scenario["bridge"]["structure"]["spans"]
    two = {"bridge.structure.spans": [span, span], "bridge.points": [{"name": "second", "x": 48.75}], "track.bays": 210}
    both = changed(examples / "r1.json", folder / "both.json", {**two, "time.end": 1.3})
    (folder / "both").mkdir()
    (folder / "single").mkdir()
    ttb("build", both, "-o", folder / "both")
    ttb("build", examples / "r1.json", "-o", folder / "single")
    ttb("run", both, "-o", folder / "out", "--quiet")
    return both, folder / "single" / "Bridge.fmu", folder / "out"


def test_two_girders_are_the_viaduct(ttb, viaduct, tmp_path):
    """The same steps to the iteration's tolerance; every bridge has its own columns, its own probe."""
    scenario, girder, joined = viaduct
    ttb("run", scenario, "--bridge", girder, "--bridge", girder, "-o", tmp_path, "--quiet")
    found, expected = read_csv(tmp_path / "results.csv"), read_csv(joined / "results.csv")
    for theirs, ours in (("Bridge2.point[mid].displacement", "point[second].displacement"), (WHEEL, WHEEL)):
        assert np.abs(found[theirs] - expected[ours]).max() < 1e-6 * np.abs(expected[ours]).max()
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert len(summary["coupling"]["probe"]["mass_per_support"]) == 2
    assert found["Bridge1.point[mid].displacement"].max() > 5e-4


def test_one_of_them_without_roll_back_makes_all_explicit(ttb, viaduct, tmp_path):
    """If one bridge cannot roll back, none does; the estimate bounds the error."""
    scenario, girder, joined = viaduct
    (tmp_path / "limited").mkdir()
    change = replaced('canGetAndSetFMUstate="true"', 'canGetAndSetFMUstate="false"')
    limited = copy(Fmu(girder), tmp_path / "limited", {DESCRIPTION: change}).path
    said = ttb("run", scenario, "--bridge", girder, "--bridge", limited, "-o", tmp_path, "--quiet").stderr
    assert "Bridge2 cannot save and restore" in said and "Bridge1 cannot" not in said
    estimate = json.loads((tmp_path / "summary.json").read_text())["coupling"]["error_estimate"]
    found, expected = (read_csv(folder / "results.csv") for folder in (tmp_path, joined))
    mid, second = found["Bridge2.point[mid].displacement"], expected["point[second].displacement"]
    assert 0 < np.abs(mid - second).max() / np.abs(second).max() < estimate < 1e-4


def test_supports_without_a_bridge_are_refused(ttb, viaduct, examples, tmp_path):
    """One girder too few, one too many, a wrong sign on the second only."""
    scenario, girder, _ = viaduct
    (tmp_path / "plain.json").write_text("{}")
    plain = ["--map", tmp_path / "plain.json"]
    one = ttb("run", scenario, "--bridge", girder, *plain, "-o", tmp_path, expect=2).stderr
    assert "98 places are mapped" in one
    three = ttb("run", scenario, *["--bridge", girder] * 3, "-o", tmp_path, expect=2).stderr
    assert "there are 98 in all" in three
    (tmp_path / "up.json").write_text(json.dumps({"displacement": {"name": "support[{i}].displacement", "factor": -1}}))
    maps = ["--map", tmp_path / "plain.json", "--map", tmp_path / "up.json"]
    up = ttb("run", scenario, *["--bridge", girder] * 2, *maps, "-o", tmp_path, expect=2).stderr
    assert "Bridge2: the displacement has the opposite sign" in up and "Bridge1" not in up
