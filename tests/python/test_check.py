"""`ttb check` finds each of many faults and none on sound FMUs; `ttb run` ends with a message that names the FMU."""

import csv
import json
import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from faulty_fmu import ALL, LIBRARY, SOUND, SOURCE, Fault, pack
from scenario import changed


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


@pytest.mark.parametrize("sound", SOUND, ids=str)
def test_what_is_allowed_is_no_finding(ttb, tmp_path, libraries, sound):
    """The control of all that follows, and oddities that the standard allows."""
    assert findings(ttb, pack(sound, tmp_path, libraries), 0) == []


def test_a_sound_foreign_fmu_runs(ttb, short, tmp_path, libraries):
    """Also the control."""
    ttb("run", short, "--bridge", pack(SOUND[0], tmp_path, libraries), "-o", tmp_path / "out")


# Rules that need another way than a fault in bridge.c, and where they are tested.
ELSEWHERE = {"library-beside": "test_a_library_beside_the_fmus_is_found"}


def test_every_rule_has_a_fault_that_it_finds_and_a_section_that_it_rests_on(ttb):
    """The rules as the program prints them."""
    rules = {line.split()[0]: line for line in ttb("check", "--rules").stdout.splitlines()}
    found = set().union(*(fault.found for fault in ALL))
    assert found | set(ELSEWHERE) == set(rules)
    assert all(name in globals() for name in ELSEWHERE.values())


@pytest.mark.parametrize("fault", ALL, ids=str)
def test_a_fault_is_found_by_its_name(ttb, tmp_path, libraries, fault):
    """Each fault is found under its name."""
    found = findings(ttb, pack(fault, tmp_path, libraries), fault.checked)
    assert {finding["name"] for finding in found} == fault.found, found
    assert all(finding["what"] and "FMI 2.0" in finding["clause"] and "ttb check " in finding["repeat"] for finding in found)


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
        assert json.loads((out / "summary.json").read_text())["status"] == {3: "ended"}.get(fault.code, "fmu-failed")


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
    """The arguments of the call, and which instance it is; temporary folders are not shown."""
    second = "fmi2Instantiate, a second instance in its process after the first was freed, with the resources file:///FMU/resources"
    for define, call in [
        ("URI_CRASH", "with the resources file:/FMU/resources"),
        ("STEP_CRASH", "fmi2DoStep from t = 0.3 s by 0.001 s"),
        ("FREE_CRASH", "fmi2FreeInstance"),
        ("SECOND_CRASH", second),
    ]:
        [found] = findings(ttb, pack(Fault("", set(), defines=[define]), tmp_path, libraries), 1)
        assert found["name"] == "crash" and found["at"].endswith(call)
        assert found["what"].startswith("a second instance") == (define == "SECOND_CRASH")


def test_a_finding_is_repeated_by_the_command_it_names(ttb, tmp_path, libraries):
    """The same finding, alone; a check that there is not is named."""
    theirs = pack(Fault("", set(), defines=["SET_FORGETS_VELOCITY"]), tmp_path, libraries)
    found = findings(ttb, theirs, 1)
    for finding in found:
        command = finding["repeat"].split()
        assert command[:3] == ["ttb", "check", str(theirs)]
        again = json.loads(ttb("check", "--json", *command[2:], expect=1).stdout)
        assert finding in again and len(again) < len(found)
    assert "roll-back" in ttb("check", theirs, "--only", "rollback", expect=2).stderr


def helper(folder, soname):
    """A library that needs another one which lies beside it in the FMU."""
    (folder / "helper.c").write_text("double helper(void) { return 1.0; }")
    (folder / "needs.c").write_text("extern double helper(void); double used(void) { return helper(); }")
    named = ["-Wl,-soname,libhelper.so"] if soname else []
    cc = ["cc", "-shared", "-fPIC", "-w"]
    subprocess.run([*cc, *named, "-o", folder / "libhelper.so", folder / "helper.c"], check=True)
    sources = [folder / "needs.c", SOURCE]
    subprocess.run([*cc, "-O1", "-o", folder / "bridge.so", *sources, "-lm", f"-L{folder}", "-lhelper"], check=True)
    beside = LIBRARY.rsplit("/", 1)[0] + "/libhelper.so"
    entries = {LIBRARY: (folder / "bridge.so").read_bytes(), beside: (folder / "libhelper.so").read_bytes()}
    return Fault("", set(), entries=lambda plain: {**plain, **entries})


def test_a_library_beside_the_fmus_is_found(ttb, short, tmp_path, libraries):
    """It runs, with a warning for other importers; without SONAME the loader cannot know it, which is said."""
    theirs = pack(helper(tmp_path, True), tmp_path, libraries)
    [found] = findings(ttb, theirs, 1)
    assert (found["severity"], found["name"]) == ("warning", "library-beside") and "libhelper.so" in found["what"]
    ttb("run", short, "--bridge", theirs, "-o", tmp_path / "out")
    theirs = pack(helper(tmp_path, False), tmp_path, libraries)
    [found] = findings(ttb, theirs, 1)
    assert found["name"] == "library" and "has no SONAME" in found["what"]


def results(ttb, short, theirs, out, *more):
    """The rows of a run that ends well."""
    ttb("run", short, "--bridge", theirs, "-o", out, *more)
    return (out / "results.csv").read_text()


@pytest.mark.parametrize("define", ["LOG_ENVIRONMENT=s", "LOG_ENVIRONMENT=((void*)1)", "STEP_CHANGES_ALL", "CHANGES_ROUNDING", "STEP_COPIES"])
def test_what_an_fmu_does_to_the_process_changes_no_result(ttb, short, tmp_path, libraries, define):
    """Another environment for the logger; rounding, traps, folder, permissions, signals; a copy of the process. The output
    folder is relative."""
    plain = results(ttb, short, pack(SOUND[0], tmp_path, libraries), tmp_path / "plain")
    theirs = pack(Fault("", set(), defines=[define]), tmp_path, libraries)
    ttb("run", short, "--bridge", theirs, "-o", "out", cwd=tmp_path)
    out = tmp_path / "out"
    theirs, plain = ([[float(x) for x in row] for row in list(csv.reader(text.splitlines()))[1:]] for text in ((out / "results.csv").read_text(), plain))
    # In the very call that changes the rounding the FMU's own numbers are rounded otherwise: 7.5e-9 of an acceleration.
    for mine, other in zip(zip(*theirs), zip(*plain)):
        assert mine == pytest.approx(other, rel=0, abs=1e-8 * max(map(abs, other)))
    assert json.loads((out / "summary.json").read_text())["status"] == "ok" and (out / "results.svg").stat().st_mode & 0o777 == 0o644


def test_what_an_fmu_logs_cannot_command_the_terminal(ttb, short, tmp_path, libraries):
    """Escapes, a line that looks like ours, a direction from right to left."""
    theirs = pack(Fault("", set(), defines=["LOGS_ESCAPES"]), tmp_path, libraries)
    for more in ([], ["--isolate"]):
        said = ttb("run", short, "--bridge", theirs, "-o", tmp_path / "out", *more, expect=4).stderr
        assert "second line" in said and not {"\x1b", "\x07", "\u202e"} & set(said)
        assert not any(line.startswith("ttb: second line") for line in said.splitlines())


def test_a_bridge_whose_derivatives_mean_the_instant_is_refused_as_one_without(ttb, examples, tmp_path, libraries):
    """A bridge of 9 t in its first mode under a car of 50 t, whose coupling without roll-back is unstable; derivatives say that nothing moves."""
    scenario = changed(examples / "r1.json", tmp_path / "s.json", {"time.end": 0.3, "time.step": 5e-3})
    capable = 'canGetAndSetFMUstate="true" canSerializeFMUstate="true" providesDirectionalDerivative="true"'
    said = []
    for promise in ("", 'providesDirectionalDerivative="true"'):
        fault = Fault("", set(), defines=["INSTANT_DERIVATIVES", "MASS=9000", "STIFFNESS=1.2e6"], replace=[(capable, promise)])
        theirs = pack(fault, tmp_path, libraries)
        said.append(ttb("run", scenario, "--bridge", theirs, "-o", tmp_path / "out", expect=3).stderr)
    assert "ρ = " in said[0] and said[0] == said[1]


def test_a_file_that_is_not_there_is_bad_input(ttb):
    """No finding on the FMU."""
    for command in ("check", "inspect"):
        assert "nowhere.fmu" in ttb(command, "nowhere.fmu", expect=2).stderr


def test_nothing_stays_behind(ttb, tmp_path, libraries, monkeypatch):
    """Crashes and hangs leave no process and no file."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    mark = f"MARK={tmp_path}"
    monkeypatch.setenv("MARK", str(tmp_path))
    for define in ("STEP_CRASH", "STEP_HANG", "LEAVES_PROCESS"):
        findings(ttb, pack(Fault("", set(), defines=[define]), tmp_path, libraries), 1)
        assert list(temporary.iterdir()) == []
        until(lambda: running(mark) == [])


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_nothing_stays_behind_of_a_check_that_is_ended(ttb, tmp_path, libraries, end):
    """An FMU that has started a process and hangs, and a check that is interrupted, asked to end, or killed."""
    theirs = pack(Fault("", set(), defines=["LEAVES_PROCESS", "STEP_HANG"]), tmp_path, libraries)
    mark = {"MARK": str(tmp_path)}
    check = subprocess.Popen([ttb.path, "check", theirs], env={**os.environ, **mark}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until(lambda: len(running(f"MARK={tmp_path}")) >= 3)
    check.send_signal(end)
    assert check.wait(10) == (-9 if end == signal.SIGKILL else 128 + end)
    until(lambda: running(f"MARK={tmp_path}") == [])


def running(mark):
    """Numbers of all processes with an entry in their environment."""
    found = []
    for path in Path("/proc").glob("[0-9]*/environ"):
        try:
            found += [path.parent.name] if mark.encode() in path.read_bytes().split(b"\0") and path.parent.name != str(os.getpid()) else []
        except OSError:
            pass
    return found


def until(holds, seconds=20):
    """Waits until something holds."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


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
