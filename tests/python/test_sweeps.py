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
