"""What `ttb run` leaves in its folder: results.csv, iterations.csv, summary.json, results.svg and the FMUs."""

import csv
import json
from xml.etree import ElementTree

import numpy as np
import pandas
import pytest
from fmpy.util import read_csv
from scenario import changed

FILES = ["Bridge.fmu", "TrainTrack.fmu", "iterations.csv", "results.csv", "results.svg", "summary.json"]


@pytest.fixture(scope="module")
def summary(r1_run):
    return json.loads((r1_run / "summary.json").read_text())


@pytest.fixture(scope="module")
def results(r1_run):
    return pandas.read_csv(r1_run / "results.csv")


def test_the_folder_holds_what_the_help_promises(r1_run):
    """Nothing half-written, nothing besides."""
    assert sorted(entry.name for entry in r1_run.iterdir()) == FILES


def test_results_have_time_and_then_every_output_by_its_fmi_name(results, r1):
    """Variables of the supports only on request."""
    names = r1.train_track.names("output") + r1.bridge.names("output")
    assert list(results.columns) == ["time"] + [name for name in names if not name.startswith("support[")]
    assert len(results) == 1101 and results["time"].iloc[-1] == 1.1


def test_supports_are_recorded_on_request_and_rows_thinned_out(ttb, examples, tmp_path, results):
    """output.supports, output.every: the last row is always there."""
    changes = {"output": {"supports": True, "every": 300}}
    ttb("run", changed(examples / "r1.json", tmp_path / "scenario.json", changes), "-o", tmp_path)
    thin = pandas.read_csv(tmp_path / "results.csv")
    assert thin["time"].tolist() == [0.0, 0.3, 0.6, 0.9, 1.1]
    assert {"support[1].force", "support[49].displacement", "support[49].velocity"} <= set(thin.columns)
    same = results[results["time"].isin(thin["time"])].reset_index(drop=True)
    assert same.equals(thin[same.columns])


def test_every_number_has_17_digits_and_fmpy_and_pandas_read_the_same(r1_run, results):
    """Written so that reading gives the same bits."""
    by_fmpy = read_csv(r1_run / "results.csv")
    assert list(by_fmpy.dtype.names) == list(results.columns)
    assert all((by_fmpy[name] == results[name].to_numpy()).all() for name in results.columns)
    with open(r1_run / "results.csv") as file:
        for row in list(csv.reader(file))[1:]:
            assert [text for text in row if float(text) != 0 and significant_digits(text) != 17] == []


def significant_digits(text):
    """Of a number as it is written."""
    return len(text.lower().split("e")[0].lstrip("-").replace(".", "").lstrip("0"))


def test_iterations_have_one_row_a_step_and_add_up_to_the_summary(r1_run, summary):
    """iterations, residual, time; roll-backs."""
    log = pandas.read_csv(r1_run / "iterations.csv")
    found = summary["iterations"]
    assert len(log) == found["steps"] == 1100
    assert {"time", "iterations", "residual", "roll_backs", "seconds"} <= set(log.columns)
    assert found["mean"] == pytest.approx(log["iterations"].mean())
    assert (found["max"], found["roll_backs"]) == (log["iterations"].max(), log["roll_backs"].sum())
    assert found["max_residual"] == log["residual"].max() <= 1e-6
    assert (log["converged"] == 1).all() and (log["seconds"] > 0).all()


def test_the_summarys_peaks_are_those_of_the_results(summary, results):
    """Value, time and, for wheels, place of both extremes of every column."""
    assert [peak["name"] for peak in summary["peaks"]] == list(results.columns[1:])
    for peak in summary["peaks"]:
        series = results[peak["name"]]
        for extreme, row in ((peak["min"], series.idxmin()), (peak["max"], series.idxmax())):
            assert (extreme["value"], extreme["time"]) == (series[row], results["time"][row])
            if peak["name"].startswith("wheel["):
                assert extreme["x"] == results[peak["name"].split(".")[0] + ".position"][row]


def test_the_summary_says_what_was_run_and_how_long_it_took(summary, ttb):
    """Status, versions, scenario hash; seconds per FMU and in the master that add up."""
    assert (summary["status"], summary["step_s"], summary["end_s"], summary["reached_s"]) == ("ok", 1e-3, 1.1, 1.1)
    assert ttb("--version").stdout.split()[-1] == summary["versions"]["ttb"]
    assert len(summary["scenario_sha256"]) == 64
    seconds = summary["seconds"]
    parts = sum(seconds[part] for part in ("train_track", "bridge", "master", "recording"))
    assert min(seconds.values()) > 0 and parts == pytest.approx(seconds["stepping"], rel=0.01)
    assert summary["times_faster_than_real_time"] == pytest.approx(1.1 / seconds["stepping"])


def test_the_hash_follows_the_physics_and_not_the_title(ttb, examples, tmp_path, summary):
    """scenario_sha256 tells whether two runs are comparable."""

    def run(changes):
        ttb("run", changed(examples / "r1.json", tmp_path / "s.json", {"time.end": 0.01, **changes}), "-o", tmp_path)
        return json.loads((tmp_path / "summary.json").read_text())["scenario_sha256"]

    assert run({}) == run({"title": "other"}) != run({"train.front_wheel": 31.0})


def test_the_picture_is_xml(r1_run):
    """results.svg opens in a browser."""
    assert ElementTree.parse(r1_run / "results.svg").getroot().tag.endswith("svg")


def test_a_run_from_another_folder_is_the_same_and_uses_the_folder_it_is_in(ttb, examples, r1_run, tmp_path):
    """Without --output: ttb-out/ below the working directory; without noise on stdout with --quiet."""
    done = ttb("run", "--quiet", examples / "r1.json", cwd=tmp_path)
    assert done.stdout == ""
    assert (tmp_path / "ttb-out" / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    assert np.array_equal([entry.name for entry in tmp_path.iterdir()], ["ttb-out"])
