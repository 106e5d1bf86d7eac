"""Trial steps before the run: FMUs whose states are not restored, wrong signs and units, bridges without fault."""

import json
import re
import subprocess

import numpy as np
import pytest
from faulty_fmu import Fault, pack
from fmpy.util import read_csv
from fmu import Fmu
from scenario import changed
from spoil import DESCRIPTION, copy, replaced

NO_STATES = ('canGetAndSetFMUstate="true"', 'canGetAndSetFMUstate="false"')


@pytest.fixture(scope="module")
def libraries(tmp_path_factory):
    return tmp_path_factory.mktemp("libraries")


@pytest.fixture(scope="module")
def short(examples, tmp_path_factory):
    """R1, its first 0.3 s, with all that happens at the supports."""
    path = tmp_path_factory.mktemp("short") / "scenario.json"
    return changed(examples / "r1.json", path, {"time.end": 0.3, "output.supports": True})


def results(ttb, scenario, bridge, out, *more):
    said = ttb("run", scenario, "--bridge", bridge, "-o", out, "--quiet", *more).stderr
    return said, read_csv(out / "results.csv"), json.loads((out / "summary.json").read_text())


@pytest.mark.parametrize("fault", ["SET_NOTHING", "SET_FORGETS_VELOCITY", "HISTORY"])
def test_a_bridge_whose_states_are_not_restored_runs_as_one_without_roll_back(ttb, short, tmp_path, libraries, fault):
    """The same bits as if its description did not promise roll-back, and a warning."""
    runs = []
    for name, replace in (("promised", []), ("not_promised", [NO_STATES])):
        (tmp_path / name).mkdir()
        theirs = pack(Fault("", set(), defines=[fault], replace=replace), tmp_path / name, libraries)
        runs.append(results(ttb, short, theirs, tmp_path / name / "out"))
    (said, promised, summary), (_, not_promised, _) = runs
    assert "a step repeated from a restored state differs" in said
    assert summary["coupling"]["method"] == "explicit"
    assert np.array_equal(promised, not_promised)


def test_a_state_that_comes_back_a_little_wrong_late_in_the_run_is_told(ttb, short, tmp_path, libraries):
    """From 0.2 s on every restored velocity is off by 1e-6 m/s, which trial steps before the run cannot show."""
    theirs = pack(Fault("", set(), defines=["SET_OFF_LATE"]), tmp_path, libraries)
    said, _, summary = results(ttb, short, theirs, tmp_path / "out")
    assert summary["coupling"]["probe"]["bridge_repeats_to"] == [0.0]
    (warning,) = (w for w in summary["warnings"] if "does not quite come back to the state it saved" in w)
    assert warning in said
    assert 0.2 < float(re.search(r"at t = ([0-9.]+) s", warning)[1]) <= 0.264


def test_a_run_that_blows_up_is_not_ok(ttb, short, tmp_path, libraries):
    """A bridge that gains energy: every step can be taken, but nobody can believe the results."""
    theirs = pack(Fault("", set(), defines=["GAINS_ENERGY"]), tmp_path, libraries)
    out = tmp_path / "out"
    done = ttb("run", short, "--bridge", theirs, "-o", out, "--quiet", "--no-probe", expect=3)
    summary = json.loads((out / "summary.json").read_text())
    assert (summary["status"], summary["reached_s"]) == ("blown-up", 0.3)
    assert "cannot be believed" in summary["error"] and summary["error"] in done.stderr


HARMLESS = ["STATIC_STATE", "SAVE_DISTURBS", "SET_ONLY_NEAR", "SET_FORGETS_INPUTS", "WRONG_DERIVATIVES", "RESET_KEEPS", "STATE_LEAK"]


@pytest.mark.parametrize("fault", HARMLESS)
def test_faults_that_a_run_does_not_feel_change_nothing(ttb, short, tmp_path, libraries, fault):
    """Their runs end with 0; the answer is that of the sound FMU."""
    runs = []
    for name, defines in (("sound", []), ("faulty", [fault])):
        (tmp_path / name).mkdir()
        theirs = pack(Fault("", set(), defines=defines), tmp_path / name, libraries)
        runs.append(results(ttb, short, theirs, tmp_path / name / "out")[1])
    assert np.array_equal(*runs)


def beams(length, stiffness, mass, elements=20):
    """Changes to R1 that give it another bridge."""
    span = {"length": length, "bending_stiffness": stiffness, "mass": mass, "elements": elements}
    return {"bridge.structure": {"type": "beams", "spans": [span]}, "bridge.points": [], "time.end": 0.02}


# Light and heavy, soft and stiff, at short and long steps; their lowest frequencies are 0.1 to 100 Hz.
SOUND = {
    "R1": {"time.end": 0.02},
    "0.3 t/m": beams(32.5, 4.4e9, 300),
    "0.5 t/m, 10 ms": {**beams(32.5, 7.4e9, 500), "time.step": 0.01},
    "150 t/m": beams(32.5, 2e12, 150e3),
    "very soft": beams(32.5, 2e8, 20e3),
    "a culvert, 10 ms": {**beams(4.0, 5e9, 5e3, 8), "time.step": 0.01},
    "0.05 ms": {"time.end": 0.001, "time.step": 5e-5},
}


@pytest.mark.parametrize("name", SOUND)
def test_no_sound_bridge_is_refused(ttb, examples, tmp_path, name):
    """With and without roll-back; the two masses are those of the deck and equal."""
    scenario = changed(examples / "r1.json", tmp_path / "scenario.json", SOUND[name])
    ttb("build", scenario, "-o", tmp_path)
    (tmp_path / "limited").mkdir()
    limited = copy(Fmu(tmp_path / "Bridge.fmu"), tmp_path / "limited", {DESCRIPTION: replaced(*NO_STATES)}).path
    for bridge, codes in ((tmp_path / "Bridge.fmu", [0]), (limited, [0, 3])):
        out = tmp_path / "out"
        command = [ttb.path, "run", scenario, "--bridge", bridge, "-o", out, "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode in codes, done.stderr
        [[by_displacement, by_velocity]] = json.loads((out / "summary.json").read_text())["coupling"]["probe"]["mass_per_support"]
        assert by_displacement == pytest.approx(by_velocity, rel=1e-6)


def series(name, factor=1.0):
    return {"name": f"support[{{i}}].{name}", "factor": factor}


# What is wrong with the factors of force, displacement, velocity; what the message must propose.
WRONG = {
    "displacement up": ((1, -1, 1), {"displacement": 1}),
    "velocity up": ((1, 1, -1), {"velocity": 1}),
    "force up": ((-1, 1, 1), {"force": 1, "displacement": -1, "velocity": -1}),
    "kN": ((1e3, 1, 1), {"force": 1, "displacement": 1e3, "velocity": 1e3}),
    "not kN": ((1e-3, 1, 1), {"force": 1, "displacement": 1e-3, "velocity": 1e-3}),
    "mm": ((1, 1e-3, 1), {"displacement": 1}),
    "mm, up": ((1, -1e-3, 1), {"displacement": 1}),
    "mm/s": ((1, 1, 1e-3), {"velocity": 1}),
    "mm and mm/s": ((1, 1e-3, 1e-3), {"force": 1e-3, "displacement": 1, "velocity": 1}),
}


@pytest.mark.parametrize("rolls_back", [True, False], ids=["roll-back", "none"])
@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_sign_or_unit_is_refused_with_the_factor_that_mends_it(ttb, examples, r1, tmp_path, case, rolls_back):
    """The map does not fit the bridge, which is one of ours."""
    factors, mended = WRONG[case]
    bridge = r1.bridge.path if rolls_back else copy(r1.bridge, tmp_path, {DESCRIPTION: replaced(*NO_STATES)}).path
    names = ["force", "displacement", "velocity"]
    map = tmp_path / "map.json"
    map.write_text(json.dumps({name: series(name, factor) for name, factor in zip(names, factors)}))
    arguments = ["run", examples / "r1.json", "--bridge", bridge, "--map", map, "-o", tmp_path / "out"]
    said = ttb(*arguments, expect=2).stderr
    proposed = {key: float(number) for key, number in re.findall(r'"(\w+)" \(\S+ …\): "factor": (\S+?)[ ,;\n]', said + "\n")}
    assert proposed == pytest.approx(mended), said
    assert not (tmp_path / "out").exists()  # no step was taken


def test_motions_that_begin_at_another_number_are_refused(ttb, examples, r1, tmp_path):
    """Forces 1 … 49, motions 2 … 50 of a bridge with one more."""
    [span] = json.loads((examples / "r1.json").read_text())["bridge"]["structure"]["spans"]
    longer = changed(examples / "r1.json", tmp_path / "longer.json", {"bridge.structure.spans": [{**span, "length": 33.0}]})
    ttb("build", longer, "-o", tmp_path)
    shifted = {"force": series("force"), **{name: {**series(name), "first": 2} for name in ("displacement", "velocity")}}
    (tmp_path / "map.json").write_text(json.dumps(shifted))
    arguments = ["run", examples / "r1.json", "--bridge", tmp_path / "Bridge.fmu", "--map", tmp_path / "map.json"]
    said = ttb(*arguments, "-o", tmp_path / "out", expect=2).stderr
    assert "not in the same order" in said and "a force at support 25 moves the deck at support 26" in said


def test_no_probe_leaves_it_to_the_user(ttb, examples, r1, tmp_path):
    """--no-probe: also a wrong sign is not looked for."""
    map = {name: series(name, factor) for name, factor in (("force", 1e-3), ("displacement", 1), ("velocity", 1))}
    (tmp_path / "map.json").write_text(json.dumps(map))
    ttb("run", examples / "r1.json", "--bridge", r1.bridge.path, "--map", tmp_path / "map.json", "--no-probe", "-o", tmp_path / "out")
