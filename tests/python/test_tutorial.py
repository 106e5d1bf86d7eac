"""The tutorials' commands run as they stand, and do what the tutorials say."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from test_foreign import libpython

GUIDE = Path(__file__).parents[2] / "docs/guide"


def commands(page):
    """Indented lines of a page that call ttb, its arguments."""
    return re.findall(r"^    ttb (.+)$", (GUIDE / page).read_text(), flags=re.MULTILINE)


def test_the_first_bridge_runs_as_it_stands(ttb, tmp_path):
    """From an empty folder to a report."""
    assert len(commands("first-bridge.md")) >= 10
    said = {command: ttb(*shlex.split(command), cwd=tmp_path).stdout for command in commands("first-bridge.md")}
    verdicts = {name: json.loads((tmp_path / "mybridge" / name / "verdicts.json").read_text()) for name in ("hslm", "heavier", "ice3", "vehicles")}
    acceleration = {}
    for name, found in verdicts.items():
        rows = {row["criterion"]: row for row in found["verdicts"]}
        acceleration[name] = rows.get("deck-acceleration", {}).get("value")
        page = (tmp_path / "mybridge" / name / "report.html").read_text()
        assert page.startswith("<!DOCTYPE html>") and "deck-acceleration" in page
    assert acceleration["heavier"] < acceleration["hslm"], "a heavier deck shakes less"
    assert "deck-acceleration" in said["report mybridge/hslm"]


def judged(folder):
    return {row["criterion"]: row for row in json.loads((folder / "verdicts.json").read_text())["verdicts"]}


def test_matrices_lead_to_a_verdict(ttb, tmp_path):
    """The page's facts file is written where the page says."""
    page = "from-matrices.md"
    facts = re.search(r"```json\n(.*?)```", (GUIDE / page).read_text(), flags=re.DOTALL).group(1)
    said = {}
    for command in commands(page):
        if "facts.json" in command:
            (tmp_path / "mybridge" / "facts.json").write_text(facts)
        said[command] = ttb(*shlex.split(command), cwd=tmp_path).stdout
    assert "4.8000, 19.2000, 43.2001" in said["inspect-bridge mybridge/scenario.json"]
    found = json.loads((tmp_path / "mybridge/hslm/verdicts.json").read_text())
    assert found["facts"]["modes_from"] == "given by the user"
    rows = judged(tmp_path / "mybridge/hslm")
    assert rows["deck-acceleration"]["value"] > 5 and rows["deflection"]["status"] in ("fulfilled", "exceeded")
    assert judged(tmp_path / "mybridge/ice3")["wheel-unloading"]["status"] == "fulfilled"


@pytest.mark.skipif(libpython() is None, reason="this Python has no shared library")
def test_a_bridge_in_python_leads_to_a_verdict(ttb, tmp_path, monkeypatch):
    """With this Python's own library; its displacement is that of the built-in beam."""
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path[1:]))
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    page = (GUIDE / "fmu-in-python.md").read_text()
    build = re.search(r"^    pythonfmu (build .+)$", page, flags=re.MULTILINE).group(1)
    for command in commands("fmu-in-python.md"):
        if command.startswith("check"):
            subprocess.run([sys.executable, "-m", "pythonfmu", *shlex.split(build)], cwd=tmp_path, check=True, capture_output=True)
        # PythonFMU itself is warned of.
        code = 1 if command.startswith("check") else 0
        done = ttb(*shlex.split(command.replace("libpython3.11.so.1.0", libpython())), cwd=tmp_path, expect=code)
        assert not re.search("^error", done.stdout, flags=re.MULTILINE)
    peaks = [json.loads((tmp_path / "mybridge" / name / "summary.json").read_text())["peaks"] for name in ("results", "built-in")]
    theirs, ours = (found["point[mid].displacement"]["max"]["value"] for found in peaks)
    assert theirs == pytest.approx(ours, rel=0.01)
    rows = json.loads((tmp_path / "mybridge/results/verdicts.json").read_text())["verdicts"]
    row = next(row for row in rows if row["criterion"] == "deck-acceleration" and row["value"])
    assert row["filter_assumed"] and "assumed" in row["reason"]
