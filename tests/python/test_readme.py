"""The examples in README.md and docs/ work: their Python runs beside R1's FMUs and results, their scenarios have no problems."""

import os
import re
import subprocess
import sys

import pytest
from conftest import REPOSITORY

PAGES = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").rglob("*.md")), *sorted(REPOSITORY.glob("fmu-*/readme.md"))]


def snippets(language):
    """All fenced blocks of a language."""
    found = []
    for page in PAGES:
        blocks = re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
        found += [pytest.param(block, id=f"{page.name} {number}") for number, block in enumerate(blocks, 1)]
    return found


@pytest.fixture(scope="module")
def folder(ttb, examples, tmp_path_factory):
    """A folder where R1 was run: ttb-out/ has both FMUs and the results."""
    folder = tmp_path_factory.mktemp("readme")
    ttb("run", examples / "r1.json", cwd=folder)
    return folder


def whole_scenarios():
    """JSON blocks with all that a scenario needs; the others are fragments."""
    return [block for block in snippets("json") if all(f'"{part}"' in block.values[0] for part in ("train", "track", "bridge", "time"))]


def test_the_readme_shows_an_fmu_in_fmpy_and_a_scenario():
    """Both are there, so that the tests below have something to run."""
    in_readme = [block.values[0] for block in snippets("python") if block.id.startswith("README.md")]
    assert any("fmpy" in block and "ttb-out/" in block for block in in_readme)
    assert any(block.id.startswith("README.md") for block in whole_scenarios())


@pytest.mark.parametrize("snippet", snippets("python"))
def test_a_snippet_runs(snippet, folder, ttb):
    """In a fresh interpreter, as if the wheel were installed."""
    environment = dict(os.environ, PYTHONPATH=str(REPOSITORY / "python"), TTB=str(ttb.path))
    command = [sys.executable, "-c", snippet]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("snippet", whole_scenarios())
def test_a_scenario_has_no_problems(snippet, ttb, tmp_path):
    """`ttb check-scenario`."""
    (tmp_path / "scenario.json").write_text(snippet)
    ttb("check-scenario", tmp_path / "scenario.json")
