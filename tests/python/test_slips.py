"""Slips of engineers: each is told before the run, with what may have been meant, and after it if results cannot be believed."""

import json
import os
import subprocess

import pytest

from scenario import changed

TRACK = {
    "rail": {"bending_stiffness": 13254040, "mass": 121.28},
    "support": {"type": "single-layer", "fastener": {"stiffness": 1e8, "damping": 72500.0}},
    "spacing": 0.65,
}
CAR = {
    "body_mass": 41750, "body_inertia": 2.08e6, "bogie_mass": 3040, "bogie_inertia": 3930, "wheelset_mass": 1780,
    "secondary_stiffness": 5.3e5, "secondary_damping": 9.02e4, "primary_stiffness": 1.18e6, "primary_damping": 3.92e4,
    "bogie_distance": 17.5, "wheelbase": 2.5, "length": 25.0,
}  # fmt: skip
SPAN = {"length": 32.5, "bending_stiffness": 4.39668e11, "mass": 29720, "elements": 50}
PAD = {"type": "single-layer", "fastener": {"stiffness": 100, "damping": 72500.0}}

# What is changed in R1, and what the warnings must say.
WARNED = {
    "pad in kN/mm": ({"track.type": TRACK | {"support": PAD}}, ["stiffness of the spring 100 N/m", "kN/mm", "19.21 m"]),
    "rail in cm⁴": (
        {"track.type": TRACK | {"rail": {"bending_stiffness": 3055, "mass": 121.28}}},
        ["rail.bending_stiffness", "or as second moment of area in cm⁴?"],
    ),
    "car in t": ({"train.cars": [CAR | {"body_mass": 41.75}]}, ["$.train.cars[0].body_mass", "given in t?"]),
    "springs in kN/m": ({"train.cars": [CAR | {"secondary_stiffness": 530}]}, ["secondary_stiffness in kN/m?"]),
    "axle load": (
        {"train.cars": [CAR | {"body_mass": 41.75, "bogie_mass": 3.04, "wheelset_mass": 1.78}]},
        ["static load of an axle 134.8 N", "masses in t?"],
    ),
    "speed in km/h": ({"train.speed": {"m_s": 250}, "time.end": 0.3}, ["usual up to 139 m/s", "that is `km_h`"]),
    "irregularity in mm": (
        {"irregularity": {"type": "harmonics", "origin": 0, "waves": [{"amplitude": 0.05, "wavelength": 25}]}},
        ["σ of the irregularity 0.03536 m", "given in mm?"],
    ),
    "mass in t/m": ({"bridge.structure.spans": [SPAN | {"mass": 29.72}]}, ["spans[0].mass", "given in t/m?"]),
    "EI in kN m²": (
        {"bridge.structure.spans": [SPAN | {"bending_stiffness": 4.4e8}]},
        ["first natural frequency 0.1809 Hz", "figure 6.10", "in kN m²"],
    ),
    "few elements": ({"bridge.structure.spans": [SPAN | {"elements": 2}]}, ["number of beam elements of the span 2, usual 8 to 800"]),
    "damping in per cent": ({"bridge.damping.ratio": 0.5}, ["damping ratio of the bridge 0.5", "given in per cent?"]),
    "no point": ({"bridge.points": []}, ["there is no monitored point"]),
    "end too early": ({"time.end": 0.5}, ["$.time.end: the run ends before the train has passed", "it leaves the bridge at t = 0.8838 s"]),
    "already past": ({"train.front_wheel": 95.0, "time.end": 0.1}, ["the train is already past at the start"]),
    "never there": ({"time.end": 0.1}, ["the train never reaches the bridge: its leading wheel comes to 36.94 m"]),
    "step in ms": ({"time.step": 1, "time.end": 1.1}, ["step 1 s: more than 0.002 s", "given in ms?"]),
}


@pytest.mark.parametrize("case", WARNED)
def test_a_slip_is_warned_of_before_the_run(ttb, examples, tmp_path, case):
    """`ttb check-scenario` accepts the scenario and says what looks wrong."""
    changes, expected = WARNED[case]
    said = ttb("check-scenario", changed(examples / "r1.json", tmp_path / "s.json", changes)).stderr
    for text in expected:
        assert text in said, said


REFUSED = {
    "hertz constant": ({"contact": {"hertz_constant": 1.4e9}}, "$.contact.hertz_constant: Hertz constant G must lie 1e-9 to 1e-6"),
    "wheel in mm": ({"contact": {"wheel_radius": 460}}, "$.contact.wheel_radius: wheel radius must lie 0.01 to 10 m: 460 m; given in mm?"),
    "endless car": ({"train.cars": [CAR | {"length": 1e16}]}, "$.train.cars[0].length: length of the car must lie 0.5 to 500 m"),
    "wheels on one place": ({"train.front_wheel": 1e18}, "$.train.front_wheel: abscissa must lie -1e8 to 1e8 m"),
    "own track beside": (
        {"track": {"from": 0, "bays": 170, **TRACK}},
        "$.track.rail: unknown key: `rail` (did you mean `track.type.rail`?)",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_meant_is_a_problem(ttb, examples, tmp_path, case):
    """Exit code 2, with place and rule."""
    changes, expected = REFUSED[case]
    said = ttb("check-scenario", changed(examples / "r1.json", tmp_path / "s.json", changes), expect=2).stderr
    assert expected in said, said


def test_results_that_cannot_be_believed_are_warnings_in_the_summary(ttb, examples, tmp_path):
    """A rail of a four-hundredth of the stiffness: wheel forces of 83 static loads."""
    changes = {"track.type": TRACK | {"rail": {"bending_stiffness": 3e4, "mass": 121.28}}}
    done = ttb("run", changed(examples / "r1.json", tmp_path / "s.json", changes), "-o", tmp_path / "out", "-q")
    warnings = json.loads((tmp_path / "out" / "summary.json").read_text())["warnings"]
    told = [warning for warning in warnings if "cannot be believed" in warning]
    assert any("beyond ten static axle loads" in warning for warning in told), warnings
    assert all(warning in done.stderr for warning in told)


def test_a_short_stiff_bridge_with_a_long_step_runs(ttb, examples, tmp_path):
    """EI 1e13 on 5 m at 2.5 ms: no wrong unit."""
    span = {"length": 5.0, "bending_stiffness": 1e13, "mass": 10000, "elements": 10}
    changes = {"bridge.structure.spans": [span], "bridge.points": [{"name": "mid", "x": 2.5}], "time.step": 2.5e-3}
    said = ttb("run", changed(examples / "r1.json", tmp_path / "s.json", changes), "-o", tmp_path / "out").stderr
    assert "map" not in said and "factor" not in said, said
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "ok"


def test_an_own_bridge_that_is_refused_is_told_by_its_keys_and_leaves_no_folder(ttb, examples, tmp_path):
    """Mass in t/m, and a thousandth of that: 0.1 kg under each support."""
    changes = {"bridge.structure.spans": [SPAN | {"mass": 0.02972, "bending_stiffness": 4.4e9}]}
    scenario = changed(examples / "r1.json", tmp_path / "s.json", changes)
    said = ttb("run", scenario, "-o", tmp_path / "out", expect=2).stderr
    assert "$.bridge.structure.spans[].mass (kg/m; given in t/m?)" in said and "--map" not in said, said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("kind", ["scenario", "model", "measured", "matrices", "map", "inspect-bridge"])
def test_an_endless_file_is_refused_at_once(ttb, examples, tmp_path, kind):
    """/dev/zero wherever a file is named."""
    scenario = tmp_path / "s.json"
    structure = {"type": "finite-elements", "model": "/dev/zero"}
    files = dict.fromkeys(("stiffness", "mass", "supports"), "/dev/zero")
    changes = {
        "model": {"bridge.structure": structure},
        "measured": {"irregularity": {"type": "measured", "file": "/dev/zero"}},
        "matrices": {"bridge.structure": {"type": "matrices", "length": 32.5, "files": files}, "bridge.points": []},
    }.get(kind, {})
    changed(examples / "r1.json", scenario, changes)
    if kind == "scenario":
        scenario = "/dev/zero"
    command = ["check-scenario", scenario]
    if kind == "inspect-bridge":
        command = ["inspect-bridge", "/dev/zero"]
    if kind == "map":
        command = ["run", scenario, "--map", "/dev/zero", "--bridge", scenario, "-o", tmp_path / "out"]
    assert "/dev/zero" in ttb(*command, expect=2).stderr


@pytest.mark.parametrize(
    "command, code",
    [
        (["sweep", "/dev/zero", "-o", "out"], 2),
        (["sweep", "s.json", "--trains", "zero.csv", "--speeds", "200", "-o", "out"], 2),
        (["sweep", "s.json", "--variants", "zero.json", "--speeds", "200", "-o", "out"], 2),
        (["campaign", "zero.json", "-o", "out"], 5),
        (["run", "s.json", "--limits", "zero.json", "-o", "out"], 2),
        (["signature", "zero.csv"], 2),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_what_sweeps_and_verdicts_read_is_bounded(ttb, examples, tmp_path, command, code):
    """The same for lists of axles, variants, plans and limits."""
    changed(examples / "r1.json", tmp_path / "s.json", {})
    for name in ("zero.csv", "zero.json"):
        (tmp_path / name).symlink_to("/dev/zero")
    assert "zero" in ttb(*command, expect=code, cwd=tmp_path).stderr


def test_a_pipe_without_a_writer_is_refused(ttb, examples, tmp_path):
    """It would be waited for without end."""
    os.mkfifo(tmp_path / "pipe")
    changed(examples / "r1.json", tmp_path / "s.json", {"irregularity": {"type": "measured", "file": "pipe"}})
    assert "pipe" in ttb("check-scenario", tmp_path / "s.json", expect=2).stderr


def test_a_scenario_may_come_from_a_pipe(ttb, examples, tmp_path):
    """`ttb check-scenario <(…)` of a shell."""
    os.mkfifo(tmp_path / "pipe")
    with subprocess.Popen(["cp", examples / "r1.json", tmp_path / "pipe"]):
        assert "no problems" in ttb("check-scenario", tmp_path / "pipe").stdout
