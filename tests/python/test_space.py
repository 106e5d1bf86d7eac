"""A run in space: its FMUs under masters in Python and in libcosim, closed forms, vertical bridges, maps, derailment."""

import json
import re

import numpy as np
import pytest
from conftest import Pair
from fmpy.util import read_csv
from fmu import FMU2Instance, Reals
from scenario import KICK, changed

SHORT = {"time.end": 0.08}
LATERAL = ("force_y", "moment_x", "displacement_y", "rotation_x", "velocity_y", "angular_velocity_x")


def test_the_plane_names_keep_their_value_references(ttb, examples, space_run, tmp_path):
    """New variables stand behind the old ones of their causality."""
    plane = json.loads((space_run / "scenario.json").read_text())
    del plane["space"]
    (tmp_path / "bridges").symlink_to(examples / "bridges")
    (tmp_path / "plane.json").write_text(json.dumps(plane))
    ttb("build", tmp_path / "plane.json", "-o", tmp_path)
    for flat, spatial in zip(vars(Pair.at(tmp_path)).values(), vars(Pair.at(space_run / "out")).values()):
        for causality in ("input", "output"):
            old, new = flat.names(causality), spatial.names(causality)
            assert new[: len(old)] == old and len(new) > len(old)


def test_a_master_in_python_comes_to_the_same_forces(space_run):
    """Fixed point of three forces a support at every step, states restored before each trial."""
    pair, h = Pair.at(space_run / "out"), 1e-3
    found = read_csv(space_run / "out" / "results.csv")
    with FMU2Instance(pair.train_track) as train, FMU2Instance(pair.bridge) as bridge:
        forces, motions = pair.bridge.names("input"), pair.train_track.names("input")
        assert {name.rpartition(".")[2] for name in forces} == {"force", "force_y", "moment_x"}
        into, out = Reals(bridge, forces), Reals(train, forces)
        moved, seen = Reals(train, motions), Reals(bridge, motions)
        force = np.zeros(len(forces))
        for instance in (train, bridge):
            instance.setupExperiment(startTime=0.0)
            instance.enterInitializationMode()
        for _ in range(12):
            into.set(force)
            moved.set(seen.get())
            force = out.get()
        for instance in (train, bridge):
            instance.exitInitializationMode()
        before = seen.get()
        for n in range(40):
            states = [instance.getFMUstate() for instance in (train, bridge)]
            guess = force
            for _ in range(12):
                for instance, state in zip((train, bridge), states):
                    instance.setFMUstate(state)
                into.set(force)
                into.set_rates((guess - force) / h)
                bridge.doStep(n * h, h, False)
                after = seen.get()
                moved.set(before)
                moved.set_rates((after - before) / h)
                train.doStep(n * h, h, False)
                guess = out.get()
            force, before = guess, after
            for instance, state in zip((train, bridge), states):
                instance.freeFMUstate(state)
        for component in ("force", "force_y", "moment_x"):
            of = [i for i, name in enumerate(forces) if name.endswith(component)]
            run = np.array([found[forces[i]][40] for i in of])
            assert np.abs(force[of] - run).max() < 2e-4 * np.abs(run).max(), component


def test_a_vertical_bridge_is_told_of_once_and_stays_at_rest_sideways(ttb, examples, space_run, tmp_path):
    """Plane beams: lateral forces go to the ground."""
    bridge = json.loads((examples / "r1.json").read_text())["bridge"]
    scenario = changed(space_run / "scenario.json", tmp_path / "s.json", {**SHORT, "bridge": {**bridge, "at": 60}})
    done = ttb("run", scenario, "-o", tmp_path / "out")
    told = [line for line in done.stderr.splitlines() if "gives no motion across the track (displacement_y) and about the track (rotation_x)" in line]
    assert len(told) == 1, done.stderr
    found = read_csv(tmp_path / "out" / "results.csv")
    assert np.abs(found["wheel[1].left.lateral_force"]).max() > 0.0


def test_a_map_names_the_new_ports(ttb, space_run, tmp_path):
    """The bridge of the run itself, through a map that names everything, and through one that leaves the roll out."""
    series = lambda name: {"name": f"support[{{i}}].{name}"}
    whole = {name: series(name) for name in LATERAL}
    partial = {name: series(name) for name in LATERAL if name not in ("moment_x", "rotation_x", "angular_velocity_x")}
    expected = read_csv(space_run / "out" / "results.csv")
    for name, map in (("whole", whole), ("ours", {}), ("partial", partial)):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "map.json").write_text(json.dumps(map))
        ttb("run", space_run / "scenario.json", "--bridge", space_run / "out" / "Bridge.fmu", "--map", folder / "map.json", "-o", folder / "out", "--quiet")
        found = read_csv(folder / "out" / "results.csv")
        assert np.array_equal(found["point[sway].displacement"], expected["point[sway].displacement"]), name


def test_the_bridges_fmu_bends_and_twists_as_closed_forms_say(ttb, tmp_path):
    """Fork ends: T ab/(L GJ) and P a²b²/(3 EI_z L), in the middle T L/4GJ and P L³/48EI_z, in initialization mode."""
    length, bays, young, poisson, inertia, torsion = 20.8, 32, 3.5e10, 0.2, 45.0, 6.0
    nodes = [[i + 1, length * i / bays, 0, 0] for i in range(bays + 1)]
    model = {
        "source": "invented",
        "materials": [{"name": "concrete", "modulus": young, "poisson": poisson, "density": 2500}],
        "line_sections": [{"name": "girder", "material": "concrete", "area": 5.2, "inertia_2": 5.0, "inertia_3": inertia, "torsion": torsion}],
        "nodes": nodes,
        "beams": [{"section": "girder", "orientation": [0, 1, 0], "elements": [[i, i + 1] for i in range(1, bays + 1)]}],
        "bearings": [{"nodes": [1, bays + 1], "fixed": ["y", "z", "rx"]}, {"nodes": [1], "fixed": ["x"]}],
        "deck": {"length": length, "on": {"beams": ["girder"]}},
    }
    (tmp_path / "girder.json").write_text(json.dumps(model))
    scenario = {
        "title": "a girder with fork ends",
        "train": {"cars": ["manchester"], "front_wheel": 30, "speed": {"m_s": 40}},
        "space": {},
        "track": {"type": "slab", "from": -39},
        "bridge": {
            "at": 39,
            "structure": {"type": "finite-elements", "model": "girder.json"},
            "damping": {"type": "none"},
        },
        "time": {"step": 1e-3, "end": 0.1},
    }
    (tmp_path / "s.json").write_text(json.dumps(scenario))
    ttb("build", tmp_path / "s.json", "-o", tmp_path)
    bridge = Pair.at(tmp_path).bridge
    count = sum(name.endswith(".force_y") for name in bridge.names("input"))
    # Supports each 0.65 m, the first and the last over the bearings or one bay beside them.
    first = 0.65 if count == bays - 1 else 0.0
    assert count in (bays - 1, bays + 1)
    shear = young / (2 * (1 + poisson))
    for support in (bays // 4, bays // 2):
        a = first + 0.65 * (support - 1)
        b = length - a
        for force, motion, expected in (
            ("moment_x", "rotation_x", a * b / (length * shear * torsion)),
            ("force_y", "displacement_y", (a * b) ** 2 / (3 * young * inertia * length)),
        ):
            with FMU2Instance(bridge) as instance:
                instance.setupExperiment(startTime=0.0)
                instance.enterInitializationMode()
                instance.set({f"support[{support}].{force}": 1e4})
                found = instance.get(f"support[{support}].{motion}")
            assert found == pytest.approx(1e4 * expected, rel=1e-9), (support, force)


def test_a_derailment_ends_the_run_with_its_axle_place_and_ratios(ttb, tmp_path):
    """Rails that turn aside by 30 mm within some metres, at 60 m/s: exit code 3, results kept, also in processes of their own."""
    (tmp_path / "kick.json").write_text(json.dumps(KICK))
    for out, more in (("out", []), ("isolated", ["--isolate=both"])):
        done = ttb("run", tmp_path / "kick.json", "-o", tmp_path / out, "--quiet", *more, expect=3)
        told = re.search(r"the train derails: the (left|right) wheel of axle 1 leaves its rail at x = (\S+) m, t = (\S+) s", done.stderr)
        assert told, done.stderr
        assert re.search(r"last Y/Q \S+ left, \S+ right", done.stderr), done.stderr
        x, t = float(told[2]), float(told[3])
        assert x == pytest.approx(25 + 60 * t, abs=1e-3)
        summary = json.loads((tmp_path / out / "summary.json").read_text())
        assert (summary["status"], summary["error"]) == ("ended", done.stderr.split("ttb: ")[-1].strip())
        found = read_csv(tmp_path / out / "results.csv")
        assert found["time"][-1] == pytest.approx(t - 1e-3, abs=1e-9) == summary["reached_s"]
        # It had climbed.
        assert found["wheel[1].right.derailment_ratio"].max() > 1.0


def test_compare_says_that_it_is_plane(ttb, space_run, tmp_path):
    """Exit code 2."""
    done = ttb("compare", space_run / "scenario.json", "-o", tmp_path / "out", expect=2)
    assert "$.space: ttb compare knows plane runs only" in done.stderr


def test_the_report_judges_what_a_plane_run_leaves_open(ttb, space_run):
    """Y/Q and Prud'homme over 2 m."""
    ttb("report", space_run / "out")
    verdicts = json.loads((space_run / "out" / "verdicts.json").read_text())["verdicts"]
    for criterion in ("derailment", "track-shift"):
        [verdict] = [one for one in verdicts if one["criterion"] == criterion]
        assert verdict["value"] is not None and verdict["limit"] is not None, verdict
