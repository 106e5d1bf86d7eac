"""What `ttb run` leaves in its folder: results.csv, iterations.csv, summary.json, pictures, the resolved scenario, the FMUs."""

import csv
import hashlib
import json
import struct
from xml.etree import ElementTree

import numpy as np
import pandas
import pytest
from fmpy.util import read_csv
from jsonschema import Draft202012Validator
from scenario import changed

FILES = ["Bridge.fmu", "TrainTrack.fmu", "assessment.json", "envelope.csv", "iterations.csv", "peaks.csv", "results.csv"]
FILES += ["results.png", "results.svg", "runs.csv", "scenario.resolved.json", "summary.json"]


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


def test_a_table_for_a_spreadsheet(ttb, examples, tmp_path, results):
    """output.columns and output.csv; a pattern that names nothing is refused with the names there are."""
    csv_form = {"separator": "semicolon", "decimal": "comma", "digits": 6}
    changes = {"output": {"columns": ["car[*].acceleration", "point[mid].*"], "csv": csv_form}}
    ttb("run", changed(examples / "r1.json", tmp_path / "scenario.json", changes), "-o", tmp_path)
    table = pandas.read_csv(tmp_path / "results.csv", sep=";", decimal=",")
    assert list(table.columns) == ["time"] + [n for n in results.columns if n == "car[1].acceleration" or n.startswith("point[mid].")]
    np.testing.assert_allclose(table, results[table.columns], rtol=1e-5)
    assert (tmp_path / "results.csv").read_text().splitlines()[10].startswith("0,009;")
    changes["output"]["columns"] = ["cars[*].acceleration"]
    refused = ttb("run", changed(examples / "r1.json", tmp_path / "scenario.json", changes), "-o", tmp_path / "b", expect=2)
    assert '"cars[*].acceleration"; there are' in refused.stderr


def test_every_number_has_17_digits_and_fmpy_and_pandas_read_the_same(r1_run, results):
    """Written so that reading gives the same bits; but for times, which are the shortest form of n h."""
    by_fmpy = read_csv(r1_run / "results.csv")
    assert list(by_fmpy.dtype.names) == list(results.columns)
    assert all((by_fmpy[name] == results[name].to_numpy()).all() for name in results.columns)
    with open(r1_run / "results.csv") as file:
        for row in list(csv.reader(file))[1:]:
            assert [text for text in row[1:] if float(text) != 0 and significant_digits(text) != 17] == []


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
    """Value, time and, for wheels, place of both extremes of every column, from the first wheel on the bridge on."""
    assert list(summary["peaks"]) == list(results.columns[1:])
    begin, end = summary["peaks_between_s"]
    assert (begin, end) == (pytest.approx(9 / (250 / 3.6)), 1.1)
    results = results[results["time"] >= begin]
    for name, peak in summary["peaks"].items():
        series = results[name]
        for extreme, row in ((peak["min"], series.idxmin()), (peak["max"], series.idxmax())):
            assert (extreme["value"], extreme["time"]) == (series[row], results["time"][row])
            if name.startswith("wheel["):
                assert extreme["x"] == results[name.split(".")[0] + ".position"][row]


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


def test_the_hash_of_a_run_follows_all_that_decides_its_results(ttb, examples, r1, tmp_path):
    """run_sha256: rows that are written, FMUs that are given, maps with their parameters; not paths, isolation or noise."""
    ttb("build", examples / "r1.json", "-o", tmp_path)
    stiffer = tmp_path / "map.json"
    stiffer.write_text(json.dumps({"parameters": {"stiffness_factor": 1.1}}))
    plain = tmp_path / "plain.json"
    plain.write_text("{}")

    def run(*options, **changes):
        changes = {"time.end": 0.002, **{key.replace("_", "."): value for key, value in changes.items()}}
        ttb("run", changed(examples / "r1.json", tmp_path / "s.json", changes), "-o", tmp_path / "out", *options)
        return json.loads((tmp_path / "out" / "summary.json").read_text())["run_sha256"]

    bridge = ("--bridge", r1.bridge.path)
    hashes = [run(), run(output_every=2), run(*bridge), run(*bridge, "--map", stiffer), run(*bridge, "--map", plain)]
    hashes.append(run("--no-probe"))
    assert len(set(hashes)) == len(hashes)
    assert run("--quiet", title="other") == hashes[0]
    assert run("--bridge", tmp_path / "Bridge.fmu", "--isolate") == hashes[2]


def test_the_summary_names_every_file_that_was_read(ttb, examples, tmp_path):
    """Path as given and SHA-256; the command, and what it means."""
    (tmp_path / "here").mkdir()
    for name in ["strutted-frame.json", "strutted-frame.csv"]:
        (tmp_path / "here" / name).write_bytes((examples / name).read_bytes())
    scenario = changed(tmp_path / "here" / "strutted-frame.json", tmp_path / "here" / "s.json", {"time.end": 0.01})
    ttb("run", "here/s.json", "-o", "out", "--no-probe", cwd=tmp_path)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    digest = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in scenario.parent.iterdir()}
    profile = json.loads(scenario.read_text())["irregularity"]["file"]
    wanted = [("scenario", "here/s.json", digest["s.json"]), ("profile", profile, digest[profile])]
    assert [(file["role"], file["path"], file["sha256"]) for file in summary["inputs"]] == wanted
    assert summary["command"][1:] == ["run", "here/s.json", "-o", "out", "--no-probe"]
    assert summary["options"]["scenario"] == "here/s.json" and summary["options"]["probe"] is False


@pytest.mark.parametrize("name", ["r1", "strutted-frame", "box-girder"])
def test_the_resolved_scenario_gives_the_same_run_from_anywhere(ttb, examples, tmp_path, name):
    """All defaults written out, files by whole paths."""
    scenario = json.loads((examples / f"{name}.json").read_text())
    scenario["time"]["end"] = 0.02
    place = examples / f"{name}-of-a-test.json"
    place.write_text(json.dumps(scenario))
    try:
        ttb("run", place, "-o", tmp_path / "a")
    finally:
        place.unlink()
    resolved = json.loads((tmp_path / "a" / "scenario.resolved.json").read_text())
    assert resolved["coupling"]["tolerance"] == 1e-6 and resolved["output"]["every"] == 1
    ttb("run", tmp_path / "a" / "scenario.resolved.json", "-o", tmp_path / "b")
    summaries = [json.loads((tmp_path / run / "summary.json").read_text()) for run in "ab"]
    assert summaries[0]["scenario_sha256"] == summaries[1]["scenario_sha256"]
    assert (tmp_path / "a" / "results.csv").read_bytes() == (tmp_path / "b" / "results.csv").read_bytes()


def test_summaries_fit_their_published_schema(ttb, examples, summary, tmp_path):
    """ttb schema --summary: of a run that is done, one that failed, one that was chosen its steps."""
    schema = json.loads(ttb("schema", "--summary").stdout)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    found = [summary]
    cases = [({"coupling.tolerance": 1e-17}, 3), ({"time.step": "auto", "time.end": 0.05}, 0)]
    for changes, code in cases:
        scenario = changed(examples / "r1.json", tmp_path / "s.json", changes)
        ttb("run", scenario, "-o", tmp_path / "out", expect=code)
        found.append(json.loads((tmp_path / "out" / "summary.json").read_text()))
    for one in found:
        assert [error.message for error in validator.iter_errors(one)] == []
    assert list(validator.iter_errors({**summary, "status": "fine"})) != []
    assert list(validator.iter_errors({**summary, "peaks": {"a": 1}})) != []


def test_the_pictures_are_xml_and_png(r1_run):
    """results.svg opens in a browser; no label is minus zero; twice as many pixels as units."""
    svg = (r1_run / "results.svg").read_text()
    root = ElementTree.fromstring(svg)
    assert root.tag.endswith("svg")
    texts = [(text.text or "").strip() for text in root.iter("{http://www.w3.org/2000/svg}text")]
    assert "train on the bridge" in texts and "mid" in texts
    assert not [text for text in texts if text.startswith("-0") and float(text) == 0]
    head = (r1_run / "results.png").read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">II", head[16:]) == (2 * int(root.get("width")), 2 * int(root.get("height")))


def test_points_that_do_not_move_down_with_the_deck_have_panels_of_their_own(ttb, examples, tmp_path):
    """A point given by a node, here one that sways."""
    (tmp_path / "bridges").symlink_to(examples / "bridges")
    scenario = changed(examples / "box-girder.json", tmp_path / "s.json", {"time.end": 0.05})
    ttb("run", scenario, "-o", tmp_path)
    texts = [(text.text or "").strip() for text in ElementTree.parse(tmp_path / "results.svg").getroot().iter()]
    titles = [text for text in texts if "displacement" in text]
    assert titles == ["Deck displacement, mm (down)", "Other points, displacement, mm"]
    first, others = (texts.index(title) for title in titles)
    assert first < texts.index("mid") < others < texts.index("sway (right)")


def test_a_run_from_another_folder_is_the_same_and_uses_the_folder_it_is_in(ttb, examples, r1_run, tmp_path):
    """Without --output: ttb-out/ below the working directory; without noise on stdout with --quiet."""
    done = ttb("run", "--quiet", examples / "r1.json", cwd=tmp_path)
    assert done.stdout == ""
    assert (tmp_path / "ttb-out" / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    assert np.array_equal([entry.name for entry in tmp_path.iterdir()], ["ttb-out"])
