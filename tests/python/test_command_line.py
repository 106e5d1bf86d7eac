"""The program's commands and exit codes: 0 ok, 2 bad input, 3 not converged, 4 an FMU failed, 5 I/O, 128 + n ended by
signal n; and folders of results."""

import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import time

import pytest
from scenario import changed
from spoil import DESCRIPTION, copy, replaced

BROKEN = {
    "train.speed": {"km_h": -250},
    "train.colour": "red",
    "track.bays": "many",
    "bridge.points": [{"name": "mid", "x": 99}],
    "time.step": 0,
}


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def test_help_teaches_the_exit_codes_and_every_command(ttb):
    """--help is where a user looks first."""
    said = " ".join(ttb("--help").stdout.split())
    codes = ["0 ok", "2 bad input", "3 a step did not converge", "4 an FMU failed", "5 input or output failed", "130 interrupted"]
    assert [code for code in codes if code not in said] == []
    for command in ("run", "build", "export-ssp", "check-scenario", "schema"):
        assert command in said
        assert "Usage: ttb" in ttb(command, "--help").stdout


def test_completions_and_the_manual_come_from_the_definition_of_the_commands(ttb, tmp_path):
    """`ttb completions` is a script that bash takes, `ttb man -o` a page for every command."""
    script = tmp_path / "ttb.bash"
    script.write_text(ttb("completions", "bash").stdout)
    offered = subprocess.run(
        ["bash", "-c", f'source {script}; COMP_WORDS=(ttb comp); COMP_CWORD=1; _ttb ttb comp ttb; echo "${{COMPREPLY[@]}}"'],
        capture_output=True, text=True, check=True,
    )
    assert offered.stdout.split() == ["compare", "completions"]
    ttb("man", "-o", tmp_path / "man1")
    pages = {page.name for page in (tmp_path / "man1").iterdir()}
    assert {"ttb.1", "ttb-run.1", "ttb-check.1"} <= pages and "ttb-host.1" not in pages
    assert ".TH ttb" in ttb("man").stdout


def test_lists_are_taken_with_commas_and_option_by_option(ttb, tmp_path):
    """Help prints lists as they can be typed."""
    assert "4e-3,2e-3" in ttb("accuracy", "--help").stdout
    for number, lengths in enumerate((["--spans", "24,30"], ["--spans", "24", "--spans", "30"])):
        folder = tmp_path / str(number)
        ttb("new", "viaduct", *lengths, folder)
        spans = json.loads((folder / "scenario.json").read_text())["bridge"]["structure"]["spans"]
        assert [span["length"] for span in spans] == [24, 30]


@pytest.mark.parametrize("arguments", [[], ["frobnicate"], ["run", "--frobnicate"], ["report"]])
def test_a_wrong_command_is_bad_input(ttb, arguments):
    """Exit code 2 and how to use it."""
    assert "Usage" in ttb(*arguments, expect=2).stderr


def test_the_schema_is_json_and_names_what_the_examples_use(ttb, examples):
    """`ttb schema`: a JSON Schema of scenario files."""
    schema = json.loads(ttb("schema").stdout)
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert set(json.loads((examples / "r1.json").read_text())) <= set(schema["properties"])


@pytest.mark.parametrize("command", [["run"], ["build"], ["check-scenario"]])
def test_a_broken_scenario_brings_all_its_problems_at_once(ttb, examples, tmp_path, command):
    """Path and rule of each problem, exit code 2, nothing written."""
    broken = changed(examples / "r1.json", tmp_path / "broken.json", BROKEN)
    output = [] if command == ["check-scenario"] else ["-o", tmp_path / "out"]
    done = ttb(*command, broken, *output, expect=2, cwd=tmp_path)
    for path in ("$.train.speed.km_h", "$.train.colour", "$.track.bays", "$.bridge.points[0].x", "$.time.step"):
        assert f"{path}: " in done.stderr
    assert done.stdout == ""
    assert [entry.name for entry in tmp_path.iterdir()] == ["broken.json"]


def test_a_scenario_that_is_not_there_is_bad_input(ttb, tmp_path):
    """Named in the message."""
    assert "nowhere.json" in ttb("run", "nowhere.json", expect=2, cwd=tmp_path).stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "settings",
    [
        {"max_iterations": 1},
        {"max_iterations": 2, "tolerance": 1e-9},
        {"tolerance": 1e-17},
        {"max_iterations": 1, "on_failure": "halve"},
    ],
    ids=str,
)
def test_a_step_that_does_not_converge_ends_the_run_with_3(ttb, examples, tmp_path, settings):
    """The message has time, residual and advice; the results so far are kept."""
    changes = {f"coupling.{key}": value for key, value in settings.items()}
    scenario = changed(examples / "r1.json", tmp_path / "scenario.json", changes)
    done = ttb("run", scenario, "-o", tmp_path, expect=3)
    assert "did not converge" in done.stderr and "t = " in done.stderr
    found = summary(tmp_path)
    assert found["status"] == "not-converged" and found["error"] in done.stderr
    assert 0 < found["reached_s"] < 1.1
    assert len((tmp_path / "results.csv").read_text().splitlines()) == found["iterations"]["steps"] + 2


def test_on_failure_accept_goes_on_and_counts(ttb, examples, tmp_path):
    """One pass a step, as an explicit master: on R1's heavy bridge the deflection is right all the same."""
    changes = {"coupling.max_iterations": 1, "coupling.on_failure": "accept"}
    ttb("run", changed(examples / "r1.json", tmp_path / "scenario.json", changes), "-o", tmp_path)
    found = summary(tmp_path)
    assert found["status"] == "ok" and found["iterations"]["mean"] == 1
    assert found["iterations"]["not_converged"] > 1000
    peak = found["peaks"]["point[mid].displacement"]["max"]["value"]
    assert peak == pytest.approx(0.65235e-3, rel=0.02)


def test_an_fmu_that_fails_ends_the_run_with_4(ttb, examples, r1, tmp_path):
    """A wrong GUID, a lost resource, no archive at all: which FMU and why."""
    wrong = copy(r1.bridge, tmp_path, {DESCRIPTION: replaced(r1.bridge.description.guid, "{0}")})
    assert "GUID" in ttb("run", examples / "r1.json", "--bridge", wrong.path, "-o", tmp_path / "out", expect=4).stderr
    lost = copy(r1.train_track, tmp_path, {"resources/train-track.json": lambda content: None})
    said = ttb("run", examples / "r1.json", "--train-track", lost.path, "-o", tmp_path / "out", expect=4).stderr
    assert "TrainTrack" in said and "train-track.json" in said
    (tmp_path / "junk.fmu").write_text("no archive")
    said = ttb("run", examples / "r1.json", "--bridge", tmp_path / "junk.fmu", "-o", tmp_path / "out", expect=4).stderr
    assert "junk.fmu" in said


def test_fmus_of_another_scenario_are_bad_input(ttb, examples, default, tmp_path):
    """Their supports do not match."""
    for option, fmu in (("--bridge", default.bridge), ("--train-track", default.train_track)):
        assert "support[50]" in ttb("run", examples / "r1.json", option, fmu.path, "-o", tmp_path, expect=2).stderr
    assert not (tmp_path / "results.csv").exists()


def test_fmus_given_on_the_command_line_give_the_same_run(ttb, examples, r1, r1_run, tmp_path):
    """Ours or anyone's: the master takes the same path."""
    ttb("run", examples / "r1.json", "--train-track", r1.train_track.path, "--bridge", r1.bridge.path, "-o", tmp_path)
    assert (tmp_path / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    assert list(tmp_path.glob("*.fmu")) == []


def test_an_output_folder_that_cannot_be_is_an_io_error(ttb, examples, tmp_path):
    """A file stands where the folder or a result should be."""
    (tmp_path / "file").write_text("")
    assert "file" in ttb("run", examples / "r1.json", "-o", tmp_path / "file", expect=5).stderr
    assert "file" in ttb("build", examples / "r1.json", "-o", tmp_path / "file" / "below", expect=5).stderr
    (tmp_path / "out" / "results.csv").mkdir(parents=True)
    assert "results.csv" in ttb("run", examples / "r1.json", "-o", tmp_path / "out", expect=5).stderr


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP], ids=lambda sent: sent.name)
def test_a_run_that_a_signal_ends_keeps_its_results(ttb, tmp_path, sent):
    """In the middle of the bundled scenario: exit 128 + n, whole rows, a summary that says so, nothing in TMPDIR."""
    temporary = tmp_path / "temporary"
    process = begin(ttb, tmp_path, temporary)
    results = tmp_path / "results.csv"
    process.send_signal(sent)
    said = process.communicate(timeout=30)[1].decode()
    assert process.returncode == 128 + sent and sent.name in said
    found = summary(tmp_path)
    assert found["status"] == "interrupted" and found["signal"] == sent.name and 0 < found["reached_s"] < 8.064
    assert emptied(temporary) and not (tmp_path / ".ttb-lock").exists()
    rows = list(csv.reader(results.open()))
    assert len(rows) == found["iterations"]["steps"] + 2
    assert {len(row) for row in rows} == {len(rows[0])}
    assert float(rows[-1][0]) == found["reached_s"]


def begin(ttb, folder, temporary, *arguments):
    """The bundled scenario, begun: some of its rows are there."""
    temporary.mkdir()
    command = [ttb.path, "run", "-o", folder, *arguments]
    environment = {**os.environ, "TMPDIR": str(temporary)}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
    results = folder / "results.csv"
    while not (results.is_file() and results.stat().st_size > 100_000) and process.poll() is None:
        time.sleep(0.01)
    return process


def emptied(folder):
    """Whether a folder becomes empty within a second: somebody may still be clearing up."""
    for _ in range(100):
        if not list(folder.iterdir()):
            return True
        time.sleep(0.01)
    return False


def test_a_second_signal_ends_a_run_at_once_and_leaves_nothing_behind(ttb, tmp_path):
    """Neither a lock nor a temporary folder; rows that are written are whole."""
    process = begin(ttb, tmp_path / "out", tmp_path / "temporary")
    os.kill(process.pid, signal.SIGSTOP)
    process.send_signal(signal.SIGTERM)
    process.send_signal(signal.SIGHUP)
    os.kill(process.pid, signal.SIGCONT)
    process.communicate(timeout=30)
    assert process.returncode in (128 + signal.SIGTERM, 128 + signal.SIGHUP)
    assert emptied(tmp_path / "temporary") and not (tmp_path / "out" / ".ttb-lock").exists()


def test_a_signal_that_is_passed_on_is_heard_once(ttb, tmp_path):
    """Ctrl-C in a terminal reaches the program and the Python that has started it, which tells the program: results are kept."""
    process = begin(ttb, tmp_path / "out", tmp_path / "temporary")
    end = time.monotonic() + 0.5
    while time.monotonic() < end and process.poll() is None:
        process.send_signal(signal.SIGINT)
        time.sleep(0.001)
    process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGINT and summary(tmp_path / "out")["status"] == "interrupted"


def test_a_command_without_results_ends_at_the_first_signal(ttb, tmp_path):
    """Here while it builds; nothing is left that is not whole, not even the folder it was to write into, and nothing fails because
    it is removed. Again and again: the signal comes as soon as there is something that could be left, and later and later."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    environment = {**os.environ, "TMPDIR": str(temporary)}
    out = tmp_path / "out"
    for i in range(40):
        process = subprocess.Popen([ttb.path, "build", "-o", out], env=environment, stdout=subprocess.DEVNULL)
        while not (out / ".ttb-lock").exists() and process.poll() is None:
            pass
        time.sleep(0.002 * i)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=30) in (143, 0)
        left = {path.name for path in out.iterdir()} if out.exists() else None
        assert emptied(temporary) and left in (None, {"TrainTrack.fmu"}, {"TrainTrack.fmu", "Bridge.fmu"})
        shutil.rmtree(out, ignore_errors=True)


def test_a_second_run_into_one_folder_is_refused_while_the_first_lasts(ttb, examples, tmp_path):
    """Exit 2 with the number of the first one's process; the first one's files stay its own, and say that it is running."""
    process = begin(ttb, tmp_path / "out", tmp_path / "temporary")
    running = summary(tmp_path / "out")
    assert running["status"] == "running" and running["process"] == process.pid
    for command in ("run", "build", "compare", "accuracy"):
        said = ttb(command, examples / "r1.json", "-o", tmp_path / "out", expect=2).stderr
        assert f"process {process.pid} is writing" in said
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=30)
    rows = list(csv.reader((tmp_path / "out" / "results.csv").open()))
    assert {len(row) for row in rows} == {len(rows[0])} and summary(tmp_path / "out")["title"] == running["title"]
    ttb("run", examples / "r1.json", "-o", tmp_path / "out")


def test_a_refused_run_leaves_the_results_of_the_one_before(ttb, examples, default, tmp_path):
    """And one that begins leaves none of them."""
    (tmp_path / "mine.txt").write_text("kept")
    ttb("run", examples / "r1.json", "-o", tmp_path, "-q")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    ttb("run", examples / "r1.json", "--bridge", default.bridge.path, "-o", tmp_path, expect=2)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    # What the one before built may be what this one is given.
    ttb("run", examples / "r1.json", "--bridge", tmp_path / "Bridge.fmu", "-o", tmp_path, "-q")
    # Of a bridge from elsewhere only the points that it tells are judged.
    assert {path.name for path in tmp_path.iterdir()} == set(before) - {"envelope.csv"}
    stopped = changed(examples / "r1.json", tmp_path / "other.json", {"coupling.tolerance": 1e-17})
    ttb("run", stopped, "-o", tmp_path, expect=3)
    assert summary(tmp_path)["status"] == "not-converged"


def test_a_disk_that_fills_leaves_whole_rows_and_a_summary_that_says_so(ttb, tmp_path):
    """Exit 5; here a limit on the size of a file that results.csv meets."""

    def limited():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000_000, 20_000_000))

    done = subprocess.run(
        [ttb.path, "run", "-o", tmp_path, "-q"], capture_output=True, text=True, preexec_fn=limited, restore_signals=False
    )
    assert done.returncode == 5 and "results.csv" in done.stderr
    assert summary(tmp_path)["status"] == "io-failed"
    text = (tmp_path / "results.csv").read_text()
    rows = list(csv.reader(text.splitlines()))
    assert text.endswith("\n") and len(rows) > 100 and {len(row) for row in rows} == {len(rows[0])}
    assert not list(tmp_path.glob("*.part"))


def test_a_temporary_folder_that_fills_is_no_fault_of_the_fmu(ttb, examples, r1, tmp_path):
    """Exit 5 with the path; here a limit on the size of a file that an unpacked library meets, and one that packing meets."""

    def run(limit, *arguments):
        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        command = [ttb.path, "run", examples / "r1.json", "-q", "-o", tmp_path / "out", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limited, restore_signals=False)
        said = [line for line in done.stderr.splitlines() if "warning" not in line]
        assert done.returncode == 5 and len(said) == 1 and not (tmp_path / "out").exists(), done.stderr
        return said[0]

    given = ["--train-track", r1.train_track.path, "--bridge", r1.bridge.path]
    assert "/binaries/linux64/" in run(200_000, *given)
    assert "TrainTrack.fmu" in run(200_000)


def test_what_a_file_or_an_fmu_says_does_not_command_the_terminal(ttb, examples, tmp_path):
    """Escape sequences are written out."""
    scenario = changed(examples / "r1.json", tmp_path / "s.json", {"title": "\x1b[31mred", "time.end": 0.002})
    said = ttb("run", scenario, "-o", tmp_path / "out")
    assert "\x1b" not in said.stdout + said.stderr and "\\u{1b}[31mred" in said.stdout
