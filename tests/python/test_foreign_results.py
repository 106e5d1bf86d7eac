"""A bridge of other people is first-class: its deck under our names, parameters of both FMUs from the scenario."""

import json

import numpy as np
import pytest
from fmpy.util import read_csv
from scenario import changed
from test_foreign import MAP, WHEEL, beam, coupled, reference  # noqa: F401

QUANTITIES = ["displacement", "velocity", "acceleration"]
# Largest difference to Bridge.fmu's own point, relative to the largest value. At rest accelerations of a finite-element
# deck ring: what is compared is their course, not their last digit.
BOUNDS = {"displacement": 2e-5, "velocity": 2e-4, "acceleration": 5e-3}


@pytest.mark.parametrize("roll_back", [True, False])
@pytest.mark.parametrize("velocities", [True, False])
def test_points_of_the_scenario_are_told_of_a_foreign_deck(ttb, reference, tmp_path, roll_back, velocities):  # noqa: F811
    """Displacement, velocity, acceleration of point[mid], between its stations; in the results and in the summary."""
    scenario, expected, ours = reference(29720, 1e-3)
    points = np.linspace(0.0, 32.5, 52)[1:-1]  # none of them at mid-span
    more = {"stations": {"name": "x{i}"}, "bearings": [0.0, 32.5], **({} if velocities else {"velocity": None})}
    bridge = beam(29720, points=points, roll_back=roll_back, velocities=velocities).write(tmp_path)
    found, summary, _ = coupled(ttb, scenario, bridge, {**MAP, **more}, tmp_path)
    for quantity in QUANTITIES:
        name = f"point[mid].{quantity}"
        own, theirs = expected[name], found[name]
        if quantity == "acceleration":  # Bridge.fmu tells it at the ends of steps, a foreign deck its means over the steps
            own = np.concatenate([[0.0], np.diff(expected["point[mid].velocity"]) / 1e-3])
        assert np.abs(theirs - own).max() <= BOUNDS[quantity] * np.abs(own).max(), quantity
        assert summary["peaks"][name]["max"]["value"] == pytest.approx(theirs.max(), rel=1e-12)
    picture = (tmp_path / "out" / "results.svg").read_text()
    assert "mid" in picture
    assert "point[station 1].displacement" not in found.dtype.names


def test_supports_and_stations_are_told_where_supports_are_asked_for(ttb, reference, tmp_path):  # noqa: F811
    """output.supports: our supports and its stations, in m and down, whatever its own names, signs and units are."""
    scenario, _, _ = reference(29720, 1e-3)
    with_supports = changed(scenario, tmp_path / "supports.json", {"output.supports": True})
    ttb("run", with_supports, "-o", tmp_path / "ours", "--quiet")
    expected = read_csv(tmp_path / "ours" / "results.csv")
    points = np.linspace(0.0, 32.5, 101)[1:-1]
    more = {"stations": {"name": "x{i}"}, "bearings": [0.0, 32.5]}
    found, summary, _ = coupled(ttb, with_supports, beam(29720, points=points).write(tmp_path), {**MAP, **more}, tmp_path)
    for name in ("support[25].displacement", "support[7].velocity"):
        assert np.abs(found[name] - expected[name]).max() <= 2e-4 * np.abs(expected[name]).max(), name
    assert np.allclose(found["point[station 50].displacement"], -1e-3 * found["w_50"], rtol=1e-12, atol=0.0)
    assert "point[station 50].acceleration" in summary["peaks"]


def test_a_point_that_is_no_place_on_the_deck_is_missed_with_a_warning(ttb, reference, tmp_path):  # noqa: F811
    """Beyond the stations."""
    scenario, _, _ = reference(29720, 1e-3)
    own = json.loads(scenario.read_text())["bridge"]["points"] + [{"name": "end", "x": 0.1}]
    scenario = changed(scenario, tmp_path / "more.json", {"bridge.points": own})
    found, _, said = coupled(ttb, scenario, beam(29720).write(tmp_path), MAP, tmp_path)
    assert "point[end]: not in the results" in said and "point[end].displacement" not in found.dtype.names
    assert "point[mid].displacement" in found.dtype.names


def test_parameters_of_both_fmus_come_from_the_scenario_and_the_map(ttb, examples, tmp_path):
    """speed of the train, stiffness of the bridge: as if the scenario itself said so; the map comes last."""
    slow = {"train.speed": {"m_s": 50.0}}
    ttb("run", changed(examples / "r1.json", tmp_path / "slow.json", slow), "-o", tmp_path / "slow", "-q")
    keys = {"fmus.train_track.parameters": {"speed": 50.0}}
    ttb("run", changed(examples / "r1.json", tmp_path / "keys.json", keys), "-o", tmp_path / "keys", "-q")
    results = [(tmp_path / name / "results.csv").read_bytes() for name in ("slow", "keys")]
    assert results[0] == results[1]
    summaries = [json.loads((tmp_path / name / "summary.json").read_text()) for name in ("slow", "keys")]
    assert summaries[0]["run_sha256"] != summaries[1]["run_sha256"]

    ttb("build", examples / "r1.json", "-o", tmp_path / "fmus")
    map = {"parameters": {"stiffness_factor": 2.0}, "train_track_parameters": {"speed": 50.0}}
    (tmp_path / "map.json").write_text(json.dumps(map))
    keys = {"fmus.bridge.parameters": {"stiffness_factor": 7.0, "mass_factor": 1.5}}
    both = changed(examples / "r1.json", tmp_path / "both.json", keys)
    ttb("run", both, "--bridge", tmp_path / "fmus/Bridge.fmu", "--map", tmp_path / "map.json", "-o", tmp_path / "a", "-q")
    keys = {
        "fmus.bridge.parameters": {"stiffness_factor": 2.0, "mass_factor": 1.5},
        "fmus.train_track.parameters": {"speed": 50.0},
    }
    ttb("run", changed(examples / "r1.json", tmp_path / "all.json", keys), "-o", tmp_path / "b", "-q")
    assert (tmp_path / "a" / "results.csv").read_bytes() == (tmp_path / "b" / "results.csv").read_bytes()
    sets = ["fmus.bridge.parameters.stiffness_factor=2.0", "fmus.bridge.parameters.mass_factor=1.5", "fmus.train_track.parameters.speed=50.0"]
    ttb("run", examples / "r1.json", *(part for key in sets for part in ("--set", key)), "-o", tmp_path / "c", "-q")
    assert (tmp_path / "c" / "results.csv").read_bytes() == (tmp_path / "b" / "results.csv").read_bytes()
    resolved = json.loads((tmp_path / "b" / "scenario.resolved.json").read_text())
    assert resolved["fmus"]["bridge"]["parameters"] == {"stiffness_factor": 2.0, "mass_factor": 1.5}


def test_parameters_that_cannot_be_are_refused_with_their_names(ttb, examples, tmp_path):
    """A wrong name, a wrong type, a step that is chosen without them, and commands that give none."""
    wrong = {"fmus.bridge.parameters": {"stifness_factor": 2.0}, "fmus.train_track.parameters": {"speed": "fast"}}
    scenario = changed(examples / "r1.json", tmp_path / "wrong.json", wrong)
    said = ttb("run", scenario, "-o", tmp_path / "out", expect=2).stderr
    assert 'speed is a Real, not "fast"' in said and "no variable `stifness_factor`" in said
    scenario = changed(examples / "r1.json", tmp_path / "one.json", {"fmus.bridge.parameters": {"stifness_factor": 2.0}})
    assert "did you mean `stiffness_factor`?" in ttb("run", scenario, "-o", tmp_path / "out", expect=2).stderr
    assert "did you mean `stiffness_factor`?" in ttb("export-ssp", scenario, "-o", tmp_path / "a.ssp", expect=2).stderr
    assert "ttb build gives no FMU parameters" in ttb("build", scenario, "-o", tmp_path / "out", expect=2).stderr
    auto = changed(examples / "r1.json", tmp_path / "auto.json", {"fmus.train_track.parameters": {"beta": 0.25}, "time.step": "auto"})
    assert "$.time.step: must be a number where fmus.train_track gives parameters" in ttb("check-scenario", auto, expect=2).stderr
    listed = changed(examples / "r1.json", tmp_path / "list.json", {"fmus.bridge.parameters": {"beta": [1]}})
    assert "$.fmus.bridge.parameters.beta" in ttb("check-scenario", listed, expect=2).stderr


def test_exported_parameters_are_bound_in_the_structure(ttb, examples, tmp_path):
    """The .ssp runs as the scenario with them."""
    scenario = changed(examples / "r1.json", tmp_path / "s.json", {"fmus.bridge.parameters": {"stiffness_factor": 2.0}})
    ttb("run", scenario, "-o", tmp_path / "a", "-q")
    ttb("export-ssp", scenario, "-o", tmp_path / "s.ssp")
    ttb("run", tmp_path / "s.ssp", "-o", tmp_path / "b", "-q")
    assert (tmp_path / "a" / "results.csv").read_bytes() == (tmp_path / "b" / "results.csv").read_bytes()
