"""Sub-steps of train and track, and steps that the program chooses: `time.substeps`, `"step": "auto"`."""

import json

import pandas
import pytest
from conftest import Pair
from scenario import changed


def run(ttb, examples, folder, changes, *arguments, name="r1.json"):
    """Summary and program output of a changed example."""
    folder.mkdir(exist_ok=True)
    done = ttb("run", changed(examples / name, folder / "scenario.json", changes), "-o", folder, *arguments)
    return json.loads((folder / "summary.json").read_text()), done


@pytest.fixture(scope="module")
def chosen(ttb, examples, tmp_path_factory):
    """R1 with a step chosen by the program."""
    folder = tmp_path_factory.mktemp("auto")
    summary, done = run(ttb, examples, folder, {"time.step": "auto"})
    return folder, summary, done


def test_work_is_reported_for_every_step_and_adds_up(ttb, examples, tmp_path):
    """iterations.csv: work, work_imbalance; summary.json: coupling.work."""
    for substeps in [1, 10]:
        summary, _ = run(ttb, examples, tmp_path / str(substeps), {"time.substeps": substeps})
        log = pandas.read_csv(tmp_path / str(substeps) / "iterations.csv")
        work = summary["coupling"]["work"]
        assert summary["substeps"] == substeps
        assert work["received"] == pytest.approx(log["work"].sum(), rel=1e-9)
        assert work["exchange_imbalance"] < 1e-12 and work["exchange_imbalance"] <= work["imbalance"] < 1e-6
        # The same work, counted by the train–track FMU.
        given = pandas.read_csv(tmp_path / str(substeps) / "results.csv")["deck_work"]
        assert given.sum() == pytest.approx((log["work"] + log["work_imbalance"]).sum(), rel=1e-9)


def test_the_choice_is_explained(chosen):
    """Frequencies, steps tried, errors by kind; printed before the run."""
    _, summary, done = chosen
    choice = summary["step_choice"]
    assert choice["irregularity_hz"] == pytest.approx(250 / 3.6 / 2)
    assert choice["supports_hz"] == pytest.approx(250 / 3.6 / 0.65)
    assert 500 < choice["wheel_rail_hz"] < 800
    taken = choice["tried"][-1]
    assert (taken["step_s"], taken["substeps"]) == (summary["step_s"], summary["substeps"]) == (1e-3, 5)
    assert taken["error"] == max(kind["error"] for kind in choice["errors"]) <= choice["allowed_error"] == 0.02
    assert "step auto: 0.001 s in 5 sub-steps: estimated error of peaks" in done.stderr
    assert summary["iterations"]["steps"] == 1100


def test_every_peaks_estimate_is_of_the_size_of_its_error(ttb, examples, chosen, tmp_path):
    """Against steps ten times smaller; the estimate is that of another stretch, so within a factor."""
    _, summary, _ = chosen
    fine, _ = run(ttb, examples, tmp_path, {"time.step": 1e-4, "coupling.tolerance": 1e-8})
    truth = fine["peaks"]
    seen = 0
    for name, peak in summary["peaks"].items():
        if name.endswith(".position") or name == "deck_work":
            assert "estimated_error" not in peak
            continue
        size = max(abs(peak["min"]["value"]), abs(peak["max"]["value"]))
        for end in ["min", "max"]:
            error = abs(peak[end]["value"] - truth[name][end]["value"])
            assert error <= peak["estimated_error"] + 1e-4 * size, f"{name} {end}"
        seen += 1
    assert seen > 15


def test_a_smaller_error_takes_smaller_steps(ttb, examples, chosen, tmp_path):
    """time.error; the steps are halved."""
    summary, _ = run(ttb, examples, tmp_path, {"time.step": "auto", "time.error": 2e-3})
    steps = [tried["step_s"] for tried in summary["step_choice"]["tried"]]
    assert steps == [1e-3 / 2**i for i in range(len(steps))] and len(steps) > 1
    assert summary["step_s"] == steps[-1] and summary["step_choice"]["tried"][-1]["error"] <= 2e-3
    assert summary["scenario_sha256"] != chosen[1]["scenario_sha256"]


def test_fmus_and_system_structures_know_the_chosen_step(ttb, examples, chosen, tmp_path):
    """ttb build, ttb export-ssp, ttb run of either."""
    scenario = changed(examples / "r1.json", tmp_path / "auto.json", {"time.step": "auto"})
    ttb("build", scenario, "-o", tmp_path)
    for name in ["TrainTrack.fmu", "Bridge.fmu"]:
        assert (tmp_path / name).read_bytes() == (chosen[0] / name).read_bytes()
    pair = Pair.at(tmp_path)
    start = {v.name: v.start for v in pair.train_track.description.modelVariables}
    assert float(start["step_size"]) == 1e-3 / 5
    assert float(pair.bridge.description.defaultExperiment.stepSize) == 1e-3
    ttb("export-ssp", scenario, "-o", tmp_path / "auto.ssp")
    ttb("run", tmp_path / "auto.ssp", "-o", tmp_path / "ssp")
    assert (tmp_path / "ssp" / "results.csv").read_bytes() == (chosen[0] / "results.csv").read_bytes()


def test_a_given_bridge_is_probed_itself(ttb, examples, chosen, tmp_path):
    """--bridge: here one that is half as stiff as the scenario's."""
    text = (examples / "r1.json").read_text().replace("4.39668e11", "2.19834e11")
    (tmp_path / "soft.json").write_text(text)
    ttb("build", tmp_path / "soft.json", "-o", tmp_path)
    summary, _ = run(ttb, examples, tmp_path / "run", {"time.step": "auto"}, "--bridge", tmp_path / "Bridge.fmu")
    errors = [kind["error"] for kind in summary["step_choice"]["errors"]]
    assert errors != [kind["error"] for kind in chosen[1]["step_choice"]["errors"]]


def test_a_given_train_and_track_need_a_given_step(ttb, examples, chosen, tmp_path):
    """Exit code 2; also for sub-steps that a foreign FMU cannot take."""
    scenario = changed(examples / "r1.json", tmp_path / "auto.json", {"time.step": "auto"})
    done = ttb("run", scenario, "--train-track", chosen[0] / "TrainTrack.fmu", "-o", tmp_path, expect=2)
    assert "with --train-track give time.step" in done.stderr
