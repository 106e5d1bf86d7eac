"""The tutorial's commands run as they stand, and do what the tutorial says."""

import json
import re
import shlex
from pathlib import Path

TUTORIAL = Path(__file__).parents[2] / "docs/guide/first-bridge.md"


def test_the_first_bridge_runs_as_it_stands(ttb, tmp_path):
    """From an empty folder to a report."""
    commands = re.findall(r"^    ttb (.+)$", TUTORIAL.read_text(), flags=re.MULTILINE)
    assert len(commands) >= 10
    said = {command: ttb(*shlex.split(command), cwd=tmp_path).stdout for command in commands}
    verdicts = {name: json.loads((tmp_path / "mybridge" / name / "verdicts.json").read_text()) for name in ("hslm", "heavier", "ice3", "vehicles")}
    acceleration = {}
    for name, found in verdicts.items():
        rows = {row["criterion"]: row for row in found["verdicts"]}
        acceleration[name] = rows.get("deck-acceleration", {}).get("value")
        page = (tmp_path / "mybridge" / name / "report.html").read_text()
        assert page.startswith("<!DOCTYPE html>") and "deck-acceleration" in page
    assert acceleration["heavier"] < acceleration["hslm"], "a heavier deck shakes less"
    assert "deck-acceleration" in said["report mybridge/hslm"]
