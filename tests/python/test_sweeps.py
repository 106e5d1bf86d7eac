"""Sweeps and campaigns as a user runs them: the same bytes however they were computed, nothing computed twice."""

import csv
import json
import os
import random
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest

TABLES = ["runs.csv", "peaks.csv", "envelope.csv", "results.h5"]
SPAN = {"length": 15, "bending_stiffness": 7.694081e9, "mass": 15000, "elements": 20}
SCENARIO = {
    "train": {"cars": ["manchester"], "speed": {"km_h": 200}},
    "bridge": {
        "structure": {"type": "beams", "spans": [SPAN]},
        "damping": {"type": "rayleigh", "ratio": 0.01},
    },
    "time": {"step": 2e-3},
}


@pytest.fixture
def scenario(tmp_path):
    path = tmp_path / "bridge.json"
    path.write_text(json.dumps(SCENARIO))
    return path


@pytest.fixture
def run(ttb):
    """Runs the program; what it has said."""

    def told(*arguments, code=0):
        done = ttb(*map(str, arguments), expect=code)
        return done.stdout + done.stderr

    return told


def made(folder):
    return [(folder / name).read_bytes() for name in TABLES]


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def test_a_modal_sweep_refined_says_what_governs_and_agrees_with_the_coupled_way(run, scenario, tmp_path):
    out = tmp_path / "out"
    arguments = ["sweep", scenario, "--trains", "hslm-a1,hslm-a10", "--speeds", "200:400", "--refine", "-o", out]
    told = run(*arguments, "-j", 2)
    assert "largest deck.acceleration" in told and "way: modal" in told
    for one in json.loads((out / "coupled-check.json").read_text()):
        assert abs(one["difference"]) < one["allowed"], one
    runs = rows(out / "runs.csv")
    assert {row["status"] for row in runs} == {"done"} and any(row["refined"] == "true" for row in runs)
    # The refined resonance of the deflection: v = f1 d / i, f1 = 5 Hz, d = 27 m of HSLM-A10, i = 2 (and d = 18 m of A1).
    ids = {row["run_id"]: row for row in runs}
    peaks = [row for row in rows(out / "peaks.csv") if row["quantity"] == "deck.displacement"]
    peaks = [row for row in peaks if row["train"] == "hslm-a1" and row["place_kind"] == "deck" and row["statistic"] == "max"]
    best = max(peaks, key=lambda row: float(row["value"]))
    assert abs(float(ids[best["run_id"]]["speed_km_h"]) / (3.6 * 5 * 18) - 1) < 0.006
    assert (out / "curves.svg").read_text().count("<polyline") >= 4
    first = made(out)
    # The same again computes nothing and gives the same bytes, as does one worker in another folder.
    before = {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()}
    run(*arguments)
    assert {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()} == before
    other = tmp_path / "other"
    run(*arguments[:-1], other, "-j", 1)
    assert made(out) == first and made(other) == first
    with h5py.File(out / "results.h5") as file:
        assert list(file["runs/run_id"].asstr()) == [row["run_id"] for row in runs]
        speeds = np.array([float(row["speed_km_h"]) for row in runs])
        assert np.array_equal(file["runs/speed_km_h"][:], speeds)
        envelope = file["envelope/deck.displacement/raw"]
        assert envelope["max"].shape == (len(runs), len(envelope["x"]))
        largest = file["peaks/deck.displacement/raw/max"][:]
        assert np.allclose(largest, envelope["max"][:].max(axis=1), rtol=0.02)
        assert len(file["history"]) >= 1


def test_a_coupled_run_has_the_bits_of_a_run_through_fmus(run, scenario, tmp_path):
    out, single = tmp_path / "out", tmp_path / "single"
    run("sweep", scenario, "--speeds", "220,260", "--way", "coupled", "-o", out, "-q")
    governing = max(rows(out / "peaks.csv"), key=lambda row: row["quantity"] == "deck.acceleration" and float(row["value"]))
    one = next(row for row in rows(out / "runs.csv") if row["run_id"] == governing["run_id"])
    assert one["basis"] == "vehicles" and one["rail"] == "smooth"
    speed = float(one["speed_m_s"])
    run("run", scenario, "--set", f"train.speed.m_s={speed!r}", "-o", single, "-q")
    kept, alone = rows(out / "history" / f"{one['run_id']}.csv"), rows(single / "results.csv")
    assert len(kept) == len(alone)
    compared = 0
    for column in kept[0]:
        name = column.rsplit(" [", 1)[0]
        if name in alone[0] and name != "time":  # which is written with 15 digits
            compared += 1
            assert [float(row[column]) for row in kept] == [float(row[name]) for row in alone], name
    assert compared >= 10


def test_killed_at_random_times_the_tables_have_the_same_bytes_and_nothing_was_computed_twice(ttb, scenario, tmp_path):
    killed(ttb, scenario, tmp_path, 6, "200:290:10")


@pytest.mark.skipif("TTB_LONG" not in os.environ, reason="takes two minutes: TTB_LONG=1 pytest test_sweeps.py -k thirty")
def test_thirty_kills(ttb, scenario, tmp_path):
    killed(ttb, scenario, tmp_path, 30, "150:390:2.5")


def killed(ttb, scenario, tmp_path, kills, speeds):
    whole, out = tmp_path / "whole", tmp_path / "killed"
    arguments = ["sweep", scenario, "--speeds", speeds, "--way", "coupled", "-q", "-j", "2", "-o"]
    begin = time.monotonic()
    ttb(*arguments, whole)
    duration, dice, seen = time.monotonic() - begin, random.Random(1), {}
    for _ in range(kills):
        process = subprocess.Popen([ttb.path, *arguments, out], stderr=subprocess.DEVNULL)
        time.sleep(dice.uniform(0.02, 1.5 * duration / kills + 0.1))
        process.kill()
        process.wait()
        for path in (out / "journal").glob("[!.]*.json"):
            when = path.stat().st_mtime_ns
            assert seen.setdefault(path.name, when) == when, "a run was computed twice"
    ttb(*arguments, out)
    assert made(out) == made(whole)


def test_shards_status_and_merge(run, scenario, tmp_path):
    plan, out, whole = tmp_path / "plan.json", tmp_path / "out", tmp_path / "whole"
    axes = {"bridge.damping.ratio": [0.01, 0.02]}
    request = {"scenario": "bridge.json", "trains": ["ice2"], "speeds": "200:280:10", "axes": axes, "variants": "bounds"}
    plan.write_text(json.dumps(request))
    run("campaign", plan, "-o", whole)
    assert len(rows(whole / "runs.csv")) == 9 * 2 * 3
    assert {row["variant"] for row in rows(whole / "runs.csv")} >= {"bridge.damping.ratio=0.01"}
    script = run("campaign", "plan", plan, "-o", out, "--tasks", "4")
    assert "--array=0-3" in script
    for shard in ["2/4", "0/4", "3/4"]:
        run("campaign", out / "plan.json", "-o", out, "--shard", shard, "-q")
    told = run("campaign", "status", out, "--shards", "4")
    assert "14 missing" in told.splitlines()[0] and "shard 1/4: 14 missing" in told
    assert "are missing" in run("campaign", "merge", out, code=2)
    run("campaign", out / "plan.json", "-o", out, "--shard", "1/4")
    run("campaign", "merge", out)
    assert made(out) == made(whole)


def test_a_changed_scenario_is_refused_and_a_failed_run_is_a_row(run, scenario, tmp_path):
    out = tmp_path / "out"
    arguments = ["sweep", scenario, "--trains", "ice2", "--speeds", "200:240:10", "-o", out]
    assert "runs" in run(*arguments, "--dry-run") and not out.exists()
    run(*arguments)
    scenario.write_text(json.dumps({**SCENARIO, "title": "another title is no other scenario"}))
    run(*arguments)
    heavier = json.loads(json.dumps(SCENARIO))
    heavier["bridge"]["structure"]["spans"][0]["mass"] = 16000
    scenario.write_text(json.dumps(heavier))
    refused = run(*arguments, code=2)
    assert "--restart" in refused and "another folder" in refused
    run(*arguments, "--restart")
    # A step that does not converge in one trial: the run is a row, the sweep goes on.
    failing = tmp_path / "failing"
    told = run("sweep", scenario, "--speeds", "200,210", "--way", "coupled", "--set", "coupling.max_iterations=1",
               "-o", failing, code=7)
    assert "failed" in told
    runs = rows(failing / "runs.csv")
    assert [row["status"] for row in runs] == ["failed", "failed"] and "converge" in runs[0]["error"]


def test_a_shard_ends_cleanly_on_sigterm(run, ttb, scenario, tmp_path):
    out = tmp_path / "out"
    arguments = [ttb.path, "sweep", scenario, "--speeds", "150:400:2.5", "--way", "coupled", "-q", "-j", "1"]
    process = subprocess.Popen([*arguments, "-o", out, "--shard", "0/2"])
    while not any((out / "journal").glob("[!.]*.json")):
        time.sleep(0.02)
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=20) == 143
    assert not list((out / "journal").glob(".*"))
    assert "missing" in run("campaign", "status", out)


UNEVEN = [SPAN | {"length": 20}, SPAN | {"length": 30, "bending_stiffness": 2e10}]
# Three axles, far from symmetric.
TRAIN = "x,load\n0,120\n3,200\n11,80\n"


@pytest.mark.parametrize("way", ["modal", "one-axle", "coupled"])
def test_a_train_from_the_other_end_is_the_same_train_over_the_mirrored_bridge(run, tmp_path, way):
    (tmp_path / "odd.csv").write_text(TRAIN)
    folders = []
    for name, spans, heading in [("a", UNEVEN, "both"), ("b", UNEVEN[::-1], "forward")]:
        scenario = json.loads(json.dumps(SCENARIO))
        scenario["bridge"]["structure"] = {"type": "beams", "spans": spans, "continuous": True}
        path = tmp_path / f"{name}.json"
        path.write_text(json.dumps(scenario))
        folder = tmp_path / name
        what = ["--trains", tmp_path / "odd.csv", "--speeds", "200,250", "--heading", heading, "--way", way]
        run("sweep", path, *what, "-o", folder)
        folders.append(folder)
    wanted = lambda row: row["place_kind"] == "deck" and row["quantity"].startswith("deck.")
    backward = [row for row in rows(folders[0] / "peaks.csv") if wanted(row) and row["train"].endswith(" backward")]
    forward = [row for row in rows(folders[0] / "peaks.csv") if wanted(row) and not row["train"].endswith(" backward")]
    mirrored = [row for row in rows(folders[1] / "peaks.csv") if wanted(row)]
    assert len(backward) == len(mirrored) > 4
    for one, other in zip(backward, mirrored):
        assert all(one[key] == other[key] for key in ["speed_km_h", "quantity", "filter", "statistic"])
        assert float(one["value"]) == pytest.approx(float(other["value"]), rel=1e-6)
        assert float(one["x_m"]) == pytest.approx(50 - float(other["x_m"]), abs=1e-6)
    assert any(abs(float(a["value"]) / float(b["value"]) - 1) > 0.01 for a, b in zip(backward, forward))


def test_vehicles_from_the_other_end_meet_the_bridge_and_its_measured_rail_mirrored(run, tmp_path):
    results = []
    for name, spans, heading in [("a", UNEVEN, "backward"), ("b", UNEVEN[::-1], "forward")]:
        rail = [(x, 1e-3 * np.sin(0.9 * x) + 4e-4 * np.cos(2.1 * x)) for x in np.arange(-400, 500, 0.25)]
        if heading == "backward":
            # The bridge lies from 0 to 50 m; the rail is told where it lies.
            rail = [(50 - x, r) for x, r in reversed(rail)]
        (tmp_path / f"{name}.csv").write_text("x,r\n" + "".join(f"{x},{float(r)!r}\n" for x, r in rail))
        scenario = json.loads(json.dumps(SCENARIO))
        scenario["bridge"]["structure"] = {"type": "beams", "spans": spans, "continuous": True}
        scenario["bridge"]["points"] = [{"name": "p", "x": 12.0 if heading == "backward" else 38.0}]
        scenario["irregularity"] = {"type": "measured", "file": f"{name}.csv"}
        if heading == "backward":
            scenario["train"]["heading"] = heading
        path = tmp_path / f"{name}.json"
        path.write_text(json.dumps(scenario))
        folder = tmp_path / f"out-{name}"
        run("run", path, "-q", "-o", folder)
        results.append(rows(folder / "results.csv"))
    assert len(results[0]) == len(results[1]) > 500
    for column in ["point[p].displacement", "wheel[1].contact_force", "car[1].acceleration"]:
        a, b = (np.array([float(row[column]) for row in of]) for of in results)
        assert np.abs(a - b).max() < 1e-6 * np.abs(b).max(), column


def test_limits_are_kept_with_the_sweep_and_another_number_computes_nothing_anew(run, scenario, tmp_path):
    out = tmp_path / "out"
    own = tmp_path / "own.json"
    entry = {"id": "deck-acceleration", "cases": [{"limit": 0.5}], "source": "the owner"}
    own.write_text(json.dumps({"criteria": [entry]}))
    arguments = ["sweep", scenario, "--trains", "hslm-a1", "--speeds", "200,210", "-o", out]
    run(*arguments, "--limits", own)
    before = {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()}
    own.unlink()
    told = run("report", out, "--check", code=6)
    assert "exceeded     deck-acceleration" in told
    entry["cases"] = [{"limit": 50.0}]
    own.write_text(json.dumps({"criteria": [entry]}))
    run(*arguments, "--limits", own)
    assert {path.name: path.stat().st_mtime_ns for path in (out / "journal").iterdir()} == before
    assert "fulfilled    deck-acceleration" in run("report", out)
    # Another filter asks for another value: the runs are computed anew, the old ones stay what they are.
    entry["filter"] = {"type": "butterworth", "order": 4, "phase": "zero", "cut_off_hz": 15}
    own.write_text(json.dumps({"criteria": [entry]}))
    run(*arguments, "--limits", own)
    assert any("15" in row["filter"] for row in rows(out / "peaks.csv"))
    own.write_text(json.dumps({"criteria": [entry | {"limmit": 3}]}))
    assert "limmit" in run(*arguments, "--limits", own, code=2)


@pytest.mark.parametrize("way", ["modal", "one-axle", "coupled"])
def test_the_histories_of_all_runs_are_kept_when_asked_for(run, scenario, tmp_path, way):
    out = tmp_path / "out"
    arguments = ["sweep", scenario, "--trains", "hslm-a1", "--speeds", "200,210,220", "--way", way, "-o", out]
    run(*arguments, "--keep-histories", "all", "--dry-run")
    assert not out.exists()
    run(*arguments, "--keep-histories", "none")
    assert not (out / "history").exists()
    tables = made(out)[:3]
    run(*arguments, "--keep-histories", "all")
    ids = {row["run_id"] for row in rows(out / "runs.csv")}
    assert {path.stem for path in (out / "history").iterdir()} == ids
    assert made(out)[:3] == tables
    # The largest value of a kept history is the row of the run.
    for one in ids:
        history = rows(out / "history" / f"{one}.csv")
        columns = [name for name in history[0] if name.endswith("acceleration [m/s2]")]
        largest = max(abs(float(row[column])) for row in history for column in columns)
        is_it = lambda row: row["run_id"] == one and row["quantity"] == "deck.acceleration" and row["filter"] == "raw"
        row = next(row for row in rows(out / "peaks.csv") if is_it(row) and row["place_kind"] == "deck")
        # Between two samples a parabola gives the row's value.
        assert largest == pytest.approx(float(row["value"]), rel=5e-3)
    with h5py.File(out / "results.h5") as file:
        assert set(file["history"]) == ids
