"""Sweeps over bridge FMUs of other programs: one plan, tables and report; what an FMU does ends its run alone."""

import csv
import hashlib
import json
import os
import signal
import subprocess
import time

import pytest
from scenario import changed
from test_foreign import MAP, PYTHON_MAP, beam, libpython, needs_libpython, python_bridge, python_path  # noqa: F401
from test_several import viaduct  # noqa: F401

# Rows of peaks.csv that are the same whoever looks at the deck: those of named points, of wheelsets and of cars.
SAME = ("point", "axle", "car")


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def verdicts(ttb, folder):
    ttb("report", folder, "--quiet")
    return json.loads((folder / "verdicts.json").read_text())["verdicts"]


@pytest.fixture
def deck(tmp_path):
    """An FMU by other names, up positive, with its map."""
    (tmp_path / "map.json").write_text(json.dumps(MAP))
    return beam(29720).write(tmp_path)


def test_our_own_bridge_as_an_fmu_gives_the_values_of_the_sweep_without_it(ttb, examples, tmp_path):
    scenario = changed(examples / "r1.json", tmp_path / "scenario.json", {"output": {"peaks_from": "start"}})
    ttb("build", scenario, "-o", tmp_path)
    common = ["sweep", scenario, "--speeds", "220,250", "-q", "-o"]
    ttb(*common, tmp_path / "own", "--way", "coupled")
    ttb(*common, tmp_path / "fmu", "--bridge", tmp_path / "Bridge.fmu")

    def values(folder):
        kept = [row for row in rows(tmp_path / folder / "peaks.csv") if row["place_kind"] in SAME]
        key = ("speed_km_h", "quantity", "place_kind", "place", "filter", "statistic")
        return {tuple(row[name] for name in key): (row["value"], row["time_s"]) for row in kept}

    own, theirs = values("own"), values("fmu")
    # A filter that follows the bridge's frequencies: those of an FMU are not known.
    by_frequency = {key for key in own if key[4] == "butterworth-4-51.479Hz-zero"}
    assert len(by_frequency) == 2 and len(theirs) > 60
    assert theirs == {key: value for key, value in own.items() if key not in by_frequency}
    # Another bridge, another run: nothing is taken from the folder of the other one.
    ids = [{row["run_id"] for row in rows(tmp_path / folder / "runs.csv")} for folder in ("own", "fmu")]
    assert len(ids[0]) == 2 and ids[0].isdisjoint(ids[1])


def test_one_speed_is_judged_as_a_run_and_the_report_names_what_was_given(ttb, examples, deck, tmp_path):
    given = ["--bridge", deck, "--map", tmp_path / "map.json", "-q", "-o"]
    ttb("run", examples / "r1.json", *given, tmp_path / "run")
    ttb("sweep", examples / "r1.json", "--speeds", "250", *given, tmp_path / "sweep")
    of_run, of_sweep = verdicts(ttb, tmp_path / "run"), verdicts(ttb, tmp_path / "sweep")
    key = ("criterion", "status", "value", "raw", "limit", "filter", "time_s", "reason", "in_basis")
    assert [[one[name] for name in key] for one in of_sweep] == [[one[name] for name in key] for one in of_run]
    assert sum(one["value"] is not None for one in of_run) > 5
    hashes = [hashlib.sha256(path.read_bytes()).hexdigest() for path in (deck, tmp_path / "map.json")]
    for folder in ("run", "sweep"):
        report = (tmp_path / folder / "report.html").read_text()
        assert all(text in report for text in ("Deck.fmu", "map.json", *hashes)), folder
    # Of the deck only the scenario's point is known: what needs more is listed as not judged.
    missing = [one["criterion"] for one in of_sweep if one["status"] == "not-judged"]
    assert "deflection" in missing and "phi" in missing


def test_trains_of_axle_loads_run_over_an_fmu_as_the_train_of_a_scenario(ttb, deck, tmp_path):
    span = {"length": 32.5, "bending_stiffness": 4.39668e11, "mass": 29720}
    scenario = {
        "train": {"cars": ["ice3"], "speed": {"km_h": 400}},
        "bridge": {"structure": {"type": "beams", "spans": [span]}, "damping": {"type": "rayleigh", "ratio": 0.05}},
        "time": {"step": 2e-3},
    }
    (tmp_path / "cars.json").write_text(json.dumps(scenario))
    (tmp_path / "forces.json").write_text(json.dumps({**scenario, "train": {"forces": "hslm-a1", "speed": {"km_h": 400}}}))
    given = ["--bridge", deck, "--map", tmp_path / "map.json", "-q", "-o"]
    ttb("run", tmp_path / "forces.json", *given, tmp_path / "run")
    for name in ("cars", "forces"):
        trains = ["--trains", "hslm-a1"] if name == "cars" else []
        ttb("sweep", tmp_path / f"{name}.json", *trains, "--speeds", "400", *given, tmp_path / name)
    of_run = verdicts(ttb, tmp_path / "run")
    key = ("criterion", "status", "value", "raw", "filter", "basis", "in_basis")
    for name in ("cars", "forces"):
        assert [[one[of] for of in key] for one in verdicts(ttb, tmp_path / name)] == [[one[of] for of in key] for one in of_run]
    [acceleration] = [one for one in of_run if one["criterion"] == "deck-acceleration"]
    assert acceleration["in_basis"] and acceleration["value"] > 0.1
    assert "Signatures" in (tmp_path / "cars" / "report.html").read_text()


def test_stations_make_an_envelope_where_no_point_is_named(ttb, examples, tmp_path):
    scenario = changed(examples / "r1.json", tmp_path / "scenario.json", {"bridge.points": []})
    deck = beam(29720, points=[3.25 * k for k in range(1, 10)]).write(tmp_path)
    (tmp_path / "map.json").write_text(json.dumps({**MAP, "stations": {"name": "x{i}"}, "bearings": [0.0, 32.5]}))
    ttb("sweep", scenario, "--bridge", deck, "--map", tmp_path / "map.json", "--speeds", "250", "-q", "-o", tmp_path / "out")
    envelope = [row for row in rows(tmp_path / "out" / "envelope.csv") if row["quantity"] == "deck.displacement"]
    assert [float(row["x_m"]) for row in envelope] == pytest.approx([3.25 * k for k in range(1, 10)], rel=1e-12)
    assert max(envelope, key=lambda row: float(row["max"]))["x_m"] in ("13", "16.25", "19.5")


def test_a_bridge_without_roll_back_is_told_with_its_error(ttb, examples, tmp_path):
    (tmp_path / "map.json").write_text(json.dumps(MAP))
    deck = beam(29720, roll_back=False).write(tmp_path)
    given = ["--bridge", deck, "--map", tmp_path / "map.json", "-o"]
    told = ttb("sweep", examples / "r1.json", "--speeds", "240,250", *given, tmp_path / "out").stderr
    ttb("run", examples / "r1.json", *given, tmp_path / "run", "-q")
    estimate = json.loads((tmp_path / "run" / "summary.json").read_text())["coupling"]["error_estimate"]
    assert "cannot save and restore its state" in told and "displacements are off by about" in told
    report = ttb("report", tmp_path / "out") and (tmp_path / "out" / "report.html").read_text()
    assert "cannot save and restore its state" in report
    # The run at 250 km/h says what ttb run says of it.
    assert f"off by about {estimate:.0e}".replace("e-0", "e-") in report


def test_several_bridges_are_judged_as_a_run_over_them(ttb, viaduct, tmp_path):  # noqa: F811
    scenario, girder, _ = viaduct
    given = ["--bridge", girder, "--bridge", girder, "-q", "-o"]
    ttb("run", scenario, *given, tmp_path / "run")
    ttb("sweep", scenario, "--speeds", "250", *given, tmp_path / "sweep")
    of_run, of_sweep = verdicts(ttb, tmp_path / "run"), verdicts(ttb, tmp_path / "sweep")
    assert [[one["criterion"], one["value"]] for one in of_sweep] == [[one["criterion"], one["value"]] for one in of_run]
    places = {row["place"] for row in rows(tmp_path / "sweep" / "peaks.csv") if row["place_kind"] == "point"}
    assert {"Bridge1.mid", "Bridge2.mid"} <= places


@needs_libpython
def test_an_fmu_in_python_gets_its_library(ttb, examples, python_bridge, python_path, tmp_path):  # noqa: F811
    (tmp_path / "map.json").write_text(json.dumps(PYTHON_MAP))
    command = ["sweep", examples / "r1.json", "--bridge", python_bridge(True), "--map", tmp_path / "map.json", "--speeds", "240,250", "-q", "-o", tmp_path / "out"]
    assert "--preload libpython" in ttb(*command, expect=4).stderr
    assert not (tmp_path / "out").exists()
    ttb(*command, "--preload", libpython())
    assert [row["status"] for row in rows(tmp_path / "out" / "runs.csv")] == ["done", "done"]


def test_another_fmu_or_map_is_another_plan(ttb, examples, deck, tmp_path):
    scenario, out = examples / "r1.json", tmp_path / "out"
    command = ["sweep", scenario, "--bridge", deck, "--map", tmp_path / "map.json", "--speeds", "240,250", "-o", out]
    ttb(*command)
    tables = [(out / name).read_bytes() for name in ("runs.csv", "peaks.csv", "envelope.csv", "results.h5")]
    kept = {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()}
    ttb(*command)
    assert {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()} == kept
    # The same from the plan that is stored, by one worker, in a folder elsewhere, whose files are found from there.
    other = tmp_path / "deep" / "other"
    ttb("campaign", out / "plan.json", "-o", other, "-j", "1")
    assert [(other / name).read_bytes() for name in ("runs.csv", "peaks.csv", "envelope.csv", "results.h5")] == tables
    ttb("campaign", other / "plan.json", "-o", other, "-q")
    ttb("report", other, "-q")
    assert "R1: one ICE 3" in (other / "report.html").read_text()
    (tmp_path / "map.json").write_text(json.dumps({**MAP, "parameters": {"Deck.mu": 20000.0}}))
    assert "another bridge or map" in ttb(*command, expect=2).stderr
    with open(deck, "ab") as file:
        file.write(b"\0")
    assert "has changed since the plan was made" in ttb("campaign", out / "plan.json", "-o", out, expect=2).stderr
    told = ttb("sweep", scenario, "--speeds", "240,250", "--way", "coupled", "-o", out, expect=2).stderr
    assert "another bridge or map" in told and "the scenario's own" in told


def test_what_an_fmu_cannot_do_is_refused_all_at_once(ttb, examples, deck, tmp_path):
    given = ["--bridge", deck, "--map", tmp_path / "map.json", "--speeds", "250", "-o", tmp_path / "out"]
    wrong = ["--way", "modal", "--variants", "bounds", "--heading", "both", "--forces"]
    told = ttb("sweep", examples / "r1.json", *given, *wrong, expect=2).stderr
    for key in ("way: ", "variants: ", "heading: ", "forces: "):
        assert key in told, told
    # What does not fit the FMU is told before the first run.
    (tmp_path / "map.json").write_text(json.dumps({**MAP, "force": {"name": "g[{i}]"}}))
    assert "g[1]" in ttb("sweep", examples / "r1.json", *given, expect=2).stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("fault", ["crashes_at", "hangs_at"])
def test_an_fmu_that_crashes_or_hangs_fails_its_run_and_not_the_sweep(ttb, examples, tmp_path, fault):
    scenario = tmp_path / "scenario.json"
    r1 = json.loads((examples / "r1.json").read_text())
    scenario.write_text(json.dumps({**r1, "track": {**r1["track"], "bays": 300}, "time": {"step": 1e-3}}))  # to the end of the passage
    (tmp_path / "map.json").write_text(json.dumps(MAP))
    deck = beam(29720, **{fault: 2.0}).write(tmp_path)
    out = tmp_path / "out"
    command = ["sweep", scenario, "--bridge", deck, "--map", tmp_path / "map.json", "--speeds", "90,250", "--timeout", "2", "-o", out]
    ttb(*command, expect=7)
    slow, fast = rows(out / "runs.csv")
    assert (slow["status"], fast["status"]) == ("failed", "done"), (slow, fast)
    assert ("SIGABRT" if fault == "crashes_at" else "2 s") in slow["error"] and "fmi2DoStep" in slow["error"]
    assert {row["speed_km_h"] for row in rows(out / "peaks.csv")} == {"250"}


def test_a_sweep_that_is_interrupted_goes_on(ttb, examples, deck, tmp_path):
    out = tmp_path / "out"
    command = ["sweep", examples / "r1.json", "--bridge", deck, "--map", tmp_path / "map.json", "--speeds", "225:250:5", "-o", out]
    begun = subprocess.Popen([ttb.path, *command, "-j", "1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    end = time.monotonic() + 60
    while not list(out.glob("journal/*")) and time.monotonic() < end:
        time.sleep(0.02)
    os.kill(begun.pid, signal.SIGINT)
    assert begun.wait(30) == 130
    done = {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()}
    assert 0 < len(done) < 6
    ttb(*command)
    after = {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()}
    assert len(after) == 6 and done.items() <= after.items()
    whole = tmp_path / "whole"
    ttb(*command[:-1], whole)
    assert all((whole / name).read_bytes() == (out / name).read_bytes() for name in ("runs.csv", "peaks.csv", "envelope.csv"))


def test_a_campaign_names_fmus_and_varies_their_parameters(ttb, examples, tmp_path):
    ttb("build", examples / "r1.json", "-o", tmp_path)
    (tmp_path / "r1.json").write_text((examples / "r1.json").read_text())
    request = {
        "scenario": "r1.json",
        "bridges": [{"fmu": "Bridge.fmu"}],
        "speeds": "250",
        "axes": {"fmus.bridge.parameters.stiffness_factor": [1.0, 2.0]},
    }
    (tmp_path / "plan.json").write_text(json.dumps(request))
    ttb("campaign", tmp_path / "plan.json", "-q", "-o", tmp_path / "out")
    deepest = {
        row["variant"]: float(row["value"])
        for row in rows(tmp_path / "out" / "peaks.csv")
        if (row["quantity"], row["place"], row["statistic"]) == ("deck.displacement", "mid", "max")
    }
    one, two = deepest.values()
    assert 0.4 < two / one < 0.6
