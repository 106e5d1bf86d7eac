"""The Python package over the program (python/ttb, docs/guide/python.md)."""

import json
import math
import os
import signal
import subprocess
import sys
import time

import numpy
import pandas
import pytest
from conftest import REPOSITORY
from scenario import KICK

sys.path.insert(0, str(REPOSITORY / "python"))
import ttb as interface  # noqa: E402

MID = "point[mid].acceleration"


@pytest.fixture(autouse=True)
def program(ttb, monkeypatch, tmp_path):
    """The program under test, in an empty folder."""
    monkeypatch.setenv("TTB", str(ttb.path))
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def short(examples):
    """R1 for a tenth of a second, as a dictionary."""
    scenario = json.loads((examples / "r1.json").read_text())
    scenario["time"] = {"step": 1e-3, "end": 0.1}
    return scenario


def test_a_run_gives_the_numbers_of_the_command_line(examples, r1_run):
    """Frame, columns, summary and peaks are those of the files, bit for bit."""
    result = interface.run(examples / "r1.json")
    assert (result.folder / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    frame, columns = result.frame(), result.columns()
    table = numpy.genfromtxt(r1_run / "results.csv", delimiter=",", names=True, deletechars="")
    assert frame.index.name == "time" and list(frame.index) == columns["time"] == list(table["time"])
    assert list(frame[MID]) == columns[MID] == list(table[MID])
    summary = json.loads((r1_run / "summary.json").read_text())
    assert result.summary["run_sha256"] == summary["run_sha256"]
    peak = result.peaks[MID]
    assert (peak.unit, peak.min.value, peak.max.time) == ("m/s2", *(summary["peaks"][MID][k][v] for k, v in (("min", "value"), ("max", "time"))))
    assert float(peak) == peak.amount == max(-peak.min.value, peak.max.value)
    assert set(result.fmus) == {"TrainTrack", "Bridge"} and all(path.is_file() for path in result.fmus.values())
    assert result.warnings == summary["warnings"] and result.scenario["train"]["cars"] == ["ice3-trailer"]


def test_a_notebook_shows_the_picture_and_peaks(short):
    """_repr_html_."""
    page = interface.run(short)._repr_html_()
    assert "<svg" in page and MID in page and "(ok, 0.1 s)" in page


def test_changes_are_keys_of_the_scenario_by_path_or_by_name(short):
    """A dictionary, and keyword arguments with two underscores for a dot; numbers of NumPy too."""
    span = "bridge.structure.spans[0].mass"
    result = interface.run(short, {span: numpy.float64(20e3)}, train__speed__km_h=280, track__type="slab")
    assert result.scenario["bridge"]["structure"]["spans"][0]["mass"] == 20e3
    assert result.scenario["train"]["speed"]["km_h"] == 280


def test_a_temporary_folder_goes_with_its_result_and_one_that_was_asked_for_stays(short, tmp_path):
    """`output`."""
    result = interface.run(short)
    folder = result.folder
    assert folder.is_dir()
    del result
    assert not folder.exists()
    interface.run(short, output=tmp_path / "kept")
    assert (tmp_path / "kept/results.csv").is_file()
    assert os.listdir(tmp_path) == ["kept"], "the dictionary's file is removed"


def test_separator_and_decimals_of_the_table_do_not_matter(short):
    """As a spreadsheet wants it."""
    first = interface.run(short)
    form = {"separator": "semicolon", "decimal": "comma"}
    second = interface.run(short, {"output.csv": form})
    assert second.columns() == first.columns()
    pandas.testing.assert_frame_equal(second.frame(), first.frame(), rtol=1e-15)


def test_all_problems_come_as_one_exception_with_their_places(short):
    """From run as from check."""
    for call in (interface.run, interface.check):
        with pytest.raises(interface.Problems) as caught:
            call({**short, "trac": 1}, {"train.cars": ["ice3-trailr"]})
        found = {problem.path: problem for problem in caught.value.problems}
        assert set(found) == {"$.trac", "$.train.cars[0]"}
        assert found["$.train.cars[0]"].suggestion == "ice3-trailer" and found["$.trac"].file == "scenario"
        assert str(caught.value).count("\n") == 1 and caught.value.code == 2 and isinstance(caught.value, ValueError)


def test_what_is_not_of_the_scenario_is_a_problem_too(short, tmp_path):
    """A map without a bridge, a file that is not there."""
    (tmp_path / "map.json").write_text("{}")
    with pytest.raises(interface.Problems, match="map"):
        interface.run(short, options=["--map", tmp_path / "map.json"])
    with pytest.raises(interface.Failed, match="nowhere.json"):
        interface.run("nowhere.json")


def test_a_run_that_fails_keeps_what_it_has_computed(short):
    """Exit code 3, with a result."""
    with pytest.raises(interface.Failed) as caught:
        interface.run(short, {"coupling": {"method": "fixed-point", "max_iterations": 1, "tolerance": 1e-14}})
    assert caught.value.code == 3 and caught.value.kind == "not converged"
    assert caught.value.result.summary["status"] == "not-converged"


def test_a_derailment_is_no_failure_to_converge():
    """Exit code 3, too, with the results until then."""
    with pytest.raises(interface.Failed, match="the train derails") as caught:
        interface.run(KICK)
    assert (caught.value.code, caught.value.kind) == (3, "ended")
    assert len(caught.value.result.frame()) > 100


def test_check_gives_warnings(examples):
    """R1 has three; the bundled scenario has none."""
    assert any("rail ends" in warning for warning in interface.check(examples / "r1.json"))
    assert interface.check() == []


def test_the_schemas_are_those_of_the_program(ttb):
    """`ttb schema`."""
    assert interface.schema() == json.loads(ttb("schema").stdout)
    assert interface.schema("bridge") == json.loads(ttb("schema", "--bridge").stdout)
    with pytest.raises(ValueError, match="verdicts"):
        interface.schema("results")


def test_a_sweep_runs_every_combination_and_one_that_fails_does_not_end_it(short, tmp_path):
    """In the order of the keys, the last changing fastest."""
    grid = {"train.speed.km_h": [200, 250], "bridge.damping.ratio": [0.01, -1.0]}
    swept = interface.sweep(short, grid, workers=2, output=tmp_path / "sweep")
    assert [tuple(changes.values()) for changes in swept.changes] == [(200, 0.01), (200, -1.0), (250, 0.01), (250, -1.0)]
    assert len(swept) == 4 and [isinstance(one, interface.Problems) for one in swept] == [False, True, False, True]
    alone = interface.run(short, {"train.speed.km_h": 250, "bridge.damping.ratio": 0.01})
    rows = swept.rows(MID)
    assert rows[2] == {"train.speed.km_h": 250, "bridge.damping.ratio": 0.01, MID: alone.peaks[MID].amount}
    assert rows[1][MID] is None and "damping" in rows[1]["error"]
    frame = swept.frame(MID)
    assert math.isnan(frame[MID][1]) and frame["train.speed.km_h"].tolist() == [200, 200, 250, 250]
    assert sorted(path.name for path in (tmp_path / "sweep").iterdir()) == ["0001", "0003"]
    assert "bad input" in swept._repr_html_() and len(swept.failed) == 2
    with pytest.raises(KeyError, match="nobody"):
        swept.rows("nobody")


INTERRUPTED = """
import sys, ttb
try:
    {}
except KeyboardInterrupt:
    sys.exit(130)
"""


def interrupt(arguments, *folders):
    """Runs Python, and interrupts it alone, as an editor does, once every run has rows."""
    environment = dict(os.environ, PYTHONPATH=str(REPOSITORY / "python"))
    process = subprocess.Popen([sys.executable, *arguments], env=environment, stderr=subprocess.DEVNULL)
    results, end = [folder / "results.csv" for folder in folders], time.monotonic() + 60
    while not all(path.is_file() and path.stat().st_size > 100_000 for path in results) and time.monotonic() < end:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=30) == 130
    for folder in folders:
        summary = json.loads((folder / "summary.json").read_text())
        assert summary["status"] == "interrupted" and 0 < summary["reached_s"] < 8.064


def test_an_interrupted_run_keeps_its_results(tmp_path):
    """KeyboardInterrupt once the program has written them; `python -m ttb` is the program."""
    interrupt(["-c", INTERRUPTED.format("ttb.run(output='out')")], tmp_path / "out")
    interrupt(["-m", "ttb", "run", "-o", "module"], tmp_path / "module")


def test_an_interrupted_sweep_ends_all_runs_and_begins_no_other(tmp_path):
    """Two at a time of three."""
    call = "ttb.sweep(None, {'irregularity.seed': [1, 2, 3]}, workers=2, output='out')"
    interrupt(["-c", INTERRUPTED.format(call)], tmp_path / "out/0001", tmp_path / "out/0002")
    assert not (tmp_path / "out/0003").exists()


def test_a_sweep_takes_the_changes_of_each_run(short):
    """A list."""
    swept = interface.sweep(short, [{"train.speed.km_h": 200}, {"bridge.damping.ratio": 0.02}])
    assert [one.summary["status"] for one in swept] == ["ok", "ok"]


def test_the_package_has_the_version_of_the_program(ttb):
    """One version for all."""
    assert ttb("--version").stdout.split() == ["ttb", interface.__version__]


def test_the_package_needs_nothing_but_python(ttb, examples, tmp_path):
    """No site packages: -S -I; a frame says that it needs pandas."""
    code = f"""
import sys
sys.path.insert(0, {str(REPOSITORY / "python")!r})
import ttb
result = ttb.run({str(examples / "r1.json")!r}, time__end=0.05)
print(len(result.columns()["time"]))
try:
    result.frame()
except ImportError as missing:
    print(missing)
"""
    environment = dict(os.environ, TTB=str(ttb.path))
    done = subprocess.run([sys.executable, "-I", "-S", "-c", code], env=environment, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0] == "51" and "pip install pandas" in done.stdout


def test_the_notebook_runs(examples, tmp_path):
    """Its cells, one after the other, in a copy of the folder; a value at the end of a cell is shown as a notebook does."""
    import ast

    notebook = json.loads((examples / "first-runs.ipynb").read_text())
    (tmp_path / "r1.json").write_bytes((examples / "r1.json").read_bytes())
    names, shown = {}, []
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        assert cell["outputs"] == [] and cell["execution_count"] is None, "kept without outputs"
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
            shown.append(value._repr_html_() if hasattr(value, "_repr_html_") else repr(value))
    assert any("<svg" in page for page in shown)
    assert len(names["swept"]) == 6 and names["swept"].failed == []
