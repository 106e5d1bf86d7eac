"""`ttb check` finds each of many faults and none on sound FMUs; `ttb run` ends with a message that names the FMU."""

import csv
import json

import pytest
from faulty_fmu import ALL, Fault, pack
from scenario import changed

SOUND = Fault("sound", set(), 0)


@pytest.fixture(scope="session")
def libraries(tmp_path_factory):
    """Compiled libraries, each once."""
    return tmp_path_factory.mktemp("libraries")


@pytest.fixture(scope="session")
def short(examples, tmp_path_factory):
    """R1, its first 0.5 s."""
    return changed(examples / "r1.json", tmp_path_factory.mktemp("short") / "scenario.json", {"time.end": 0.5})


def findings(ttb, path, expect):
    """Findings, by name."""
    return json.loads(ttb("check", "--json", "--timeout", "2", path, expect=expect).stdout)


def test_our_fmus_are_without_findings(ttb, any_fmu):
    """Our FMUs do what their descriptions say."""
    assert ttb("check", any_fmu.path).stdout == f"{any_fmu.path}: no findings\n"


def test_a_sound_foreign_fmu_is_without_findings(ttb, short, tmp_path, libraries):
    """The control of all that follows."""
    theirs = pack(SOUND, tmp_path, libraries)
    assert findings(ttb, theirs, 0) == []
    ttb("run", short, "--bridge", theirs, "-o", tmp_path / "out")


@pytest.mark.parametrize("fault", ALL, ids=str)
def test_a_fault_is_found_by_its_name(ttb, tmp_path, libraries, fault):
    """Each fault is found under its name."""
    found = findings(ttb, pack(fault, tmp_path, libraries), fault.checked)
    assert {finding["name"] for finding in found} == fault.found, found
    assert all(finding["what"] for finding in found)


@pytest.mark.parametrize("fault", [fault for fault in ALL if fault.code is not None], ids=str)
def test_a_run_ends_with_the_right_code_and_names_the_fmu(ttb, short, tmp_path, libraries, fault):
    """Message and exit code are as expected, and results are kept."""
    theirs, out = pack(fault, tmp_path, libraries), tmp_path / "out"
    said = ttb("run", short, "--bridge", theirs, "-o", out, expect=fault.code).stderr
    if fault.code != 0 or fault.says:
        assert ("theirs.fmu" in said or "Bridge" in said) and fault.says in said, said
    if fault.reached is not None:
        rows = list(csv.reader((out / "results.csv").open()))
        assert float(rows[-1][0]) == pytest.approx(fault.reached, abs=2e-3)
        assert {len(row) for row in rows} == {len(rows[0])}
        assert json.loads((out / "summary.json").read_text())["status"] == "fmu-failed"


def test_one_line_a_finding_and_the_count_at_the_end(ttb, tmp_path, libraries):
    """Severity, name, what, where, evidence."""
    theirs = pack(Fault("", set(), defines=["NAN_LATE"]), tmp_path, libraries)
    done = ttb("check", theirs, expect=1)
    [line] = done.stdout.splitlines()
    assert line.startswith("error") and " nan " in line
    assert "support[1].displacement, t = 0.301" in line
    assert done.stderr == f"ttb: {theirs}: 1 findings\n"


def test_a_remark_is_told_and_is_no_failure(ttb, tmp_path, libraries):
    """Most importers never ask for a step elsewhere: nothing is wrong with a run."""
    theirs = pack(Fault("", set(), defines=["ANY_TIME"]), tmp_path, libraries)
    done = ttb("check", theirs, expect=0)
    [line] = done.stdout.splitlines()
    assert line.startswith("remark") and " step-elsewhere " in line and "fmi2DoStep from t = 0.011 s" in line
    assert done.stderr == ""


def test_a_crash_says_during_which_call(ttb, tmp_path, libraries):
    """The arguments of the call; temporary folders are not shown."""
    for define, call in [
        ("URI_CRASH", "fmi2Instantiate with the resources file:/FMU/resources"),
        ("STEP_CRASH", "fmi2DoStep from t = 0.3 s by 0.001 s"),
        ("FREE_CRASH", "fmi2FreeInstance"),
    ]:
        [found] = findings(ttb, pack(Fault("", set(), defines=[define]), tmp_path, libraries), 1)
        assert (found["name"], found["at"]) == ("crash", call)


def test_a_file_that_is_not_there_is_bad_input(ttb):
    """No finding on the FMU."""
    for command in ("check", "inspect"):
        assert "nowhere.fmu" in ttb(command, "nowhere.fmu", expect=2).stderr


def test_nothing_stays_behind(ttb, tmp_path, libraries, monkeypatch):
    """Crashes and hangs leave no process and no file."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    for define in ("STEP_CRASH", "STEP_HANG"):
        findings(ttb, pack(Fault("", set(), defines=[define]), tmp_path, libraries), 1)
    assert list(temporary.iterdir()) == []


INSPECTED = [
    (None, ("support[{i}].force", 1, 1.0), ("support[{i}].displacement", 1, 1.0), ("support[{i}].velocity", 1, 1.0)),
    ("foreign", ("f[{i}]", 0, 1e-3), ("Deck.uz_{i}", 0, -1e3), None),
    ("bare", ("F{i}", 1, 1.0), ("disp{i}", 1, 1.0), ("vel{i}", 1, 1.0)),
]


def foreign(kind):
    """Descriptions with other names, units and signs; without any units."""
    if kind is None:
        return []
    names = {"foreign": ("f[{}]", "Deck.uz_{}", "dev.x{}"), "bare": ("F{}", "disp{}", "vel{}")}[kind]
    first = 0 if kind == "foreign" else 1
    series = zip(("force", "displacement", "velocity"), names)
    renamed = [(f'"support[{i + 1}].{old}"', f'"{new.format(i + first)}"') for old, new in series for i in range(49)]
    if kind == "bare":
        return renamed + [(f'unit="{unit}"', "") for unit in ("N", "m", "m/s")]
    return renamed + [
        ('<BaseUnit kg="1" m="1" s="-2"/>', '<BaseUnit kg="1" m="1" s="-2" factor="1e3"/>'),
        ('<BaseUnit m="1"/>', '<BaseUnit m="1" factor="1e-3"/>'),
        ('<BaseUnit m="1" s="-1"/>', '<BaseUnit/>'),
        ('causality="output"', 'causality="output" description="of the deck, positive up"'),
    ]


@pytest.mark.parametrize("kind, force, displacement, velocity", INSPECTED, ids=["ours", "foreign", "bare"])
def test_inspect_proposes_a_map(ttb, tmp_path, libraries, kind, force, displacement, velocity):
    """By names, units and what the descriptions say of the sign."""
    theirs = pack(Fault("", set(), replace=foreign(kind)), tmp_path, libraries)
    map = json.loads(ttb("inspect", "--map", theirs).stdout)
    for name, expected in (("force", force), ("displacement", displacement), ("velocity", velocity)):
        given = map[name]
        assert (given and (given["name"], given["first"], given["factor"])) == expected


def test_inspect_lists_series_with_their_counts(ttb, r1):
    """Runs nothing of the FMU: also one of another platform can be looked at."""
    said = ttb("inspect", r1.bridge.path).stdout
    [line] = [line.split() for line in said.splitlines() if line.startswith("support[1..49].force")]
    assert line == ["support[1..49].force", "49", "input", "N"]
    assert "linux64" in said and "rolls back" in said
    ttb("inspect", "--map", r1.train_track.path, expect=2)
