"""A run in space: both FMUs in `ttb check` and under a master in Python, vertical bridges, maps, what is refused."""

import json

import numpy as np
import pytest
from conftest import Pair
from fmpy.util import read_csv
from fmu import FMU2Instance, Reals
from scenario import changed

SHORT = {"time.end": 0.08}
LATERAL = ("force_y", "moment_x", "displacement_y", "rotation_x", "velocity_y", "angular_velocity_x")


@pytest.fixture(scope="module")
def space(ttb, examples, tmp_path_factory):
    """A short stretch of examples/space-manchester.json: its folder, with FMUs and results."""
    folder = tmp_path_factory.mktemp("space")
    (folder / "bridges").symlink_to(examples / "bridges")
    scenario = changed(examples / "space-manchester.json", folder / "scenario.json", {**SHORT, "train.front_wheel": 62})
    ttb("run", scenario, "-o", folder / "out", "--quiet", "--set", "output.supports=true")
    return folder


def test_check_finds_nothing_in_either_fmu(ttb, space):
    """`ttb check`: description, life cycle, states, derivatives."""
    for name in ("TrainTrack.fmu", "Bridge.fmu"):
        ttb("check", space / "out" / name)


def test_the_plane_names_keep_their_value_references(ttb, examples, space, tmp_path):
    """New variables stand behind the old ones of their causality."""
    plane = json.loads((space / "scenario.json").read_text())
    del plane["space"]
    (tmp_path / "bridges").symlink_to(examples / "bridges")
    (tmp_path / "plane.json").write_text(json.dumps(plane))
    ttb("build", tmp_path / "plane.json", "-o", tmp_path)
    for flat, spatial in zip(vars(Pair.at(tmp_path)).values(), vars(Pair.at(space / "out")).values()):
        for causality in ("input", "output"):
            old, new = flat.names(causality), spatial.names(causality)
            assert new[: len(old)] == old and len(new) > len(old)


def test_a_master_in_python_comes_to_the_same_forces(space):
    """Fixed point of three forces a support at every step, states restored before each trial."""
    pair, h = Pair.at(space / "out"), 1e-3
    found = read_csv(space / "out" / "results.csv")
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


def test_a_vertical_bridge_is_told_of_once_and_stays_at_rest_sideways(ttb, examples, space, tmp_path):
    """Plane beams: lateral forces go to the ground."""
    bridge = json.loads((examples / "r1.json").read_text())["bridge"]
    scenario = changed(space / "scenario.json", tmp_path / "s.json", {**SHORT, "bridge": {**bridge, "at": 60}})
    done = ttb("run", scenario, "-o", tmp_path / "out")
    told = [line for line in done.stderr.splitlines() if "gives no motion across the track (displacement_y) and about the track (rotation_x)" in line]
    assert len(told) == 1, done.stderr
    found = read_csv(tmp_path / "out" / "results.csv")
    assert np.abs(found["wheel[1].left.lateral_force"]).max() > 0.0


def test_a_map_names_the_new_ports(ttb, space, tmp_path):
    """The bridge of the run itself, through a map that names everything, and through one that leaves the roll out."""
    series = lambda name: {"name": f"support[{{i}}].{name}"}
    whole = {name: series(name) for name in LATERAL}
    partial = {name: series(name) for name in LATERAL if name not in ("moment_x", "rotation_x", "angular_velocity_x")}
    expected = read_csv(space / "out" / "results.csv")
    for name, map in (("whole", whole), ("ours", {}), ("partial", partial)):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "map.json").write_text(json.dumps(map))
        ttb("run", space / "scenario.json", "--bridge", space / "out" / "Bridge.fmu", "--map", folder / "map.json", "-o", folder / "out", "--quiet")
        found = read_csv(folder / "out" / "results.csv")
        assert np.array_equal(found["point[sway].displacement"], expected["point[sway].displacement"]), name


def test_compare_says_that_it_is_plane(ttb, space, tmp_path):
    """Exit code 2."""
    done = ttb("compare", space / "scenario.json", "-o", tmp_path / "out", expect=2)
    assert "$.space: ttb compare knows plane runs only" in done.stderr


def test_the_report_judges_what_a_plane_run_leaves_open(ttb, space):
    """Y/Q and Prud'homme over 2 m."""
    ttb("report", space / "out")
    verdicts = json.loads((space / "out" / "verdicts.json").read_text())["verdicts"]
    for criterion in ("derailment", "track-shift"):
        [verdict] = [one for one in verdicts if one["criterion"] == criterion]
        assert verdict["value"] is not None and verdict["limit"] is not None, verdict
