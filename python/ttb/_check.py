"""``ttb.check`` and ``ttb.schema``."""

from __future__ import annotations

import json
from typing import Any, Mapping, Optional

from ._errors import Failed, Problem, Problems, message
from ._program import Done, call
from ._scenario import GIVEN, Scenario, file, settings


def check(scenario: Scenario = None, changes: Optional[Mapping[str, Any]] = None, **more: Any) -> list[str]:
    """Checks a scenario, and gives its warnings; an empty list if there is nothing to remark.

    ``scenario`` and the changes are those of :func:`ttb.run`. Raises Problems, with all places at once.
    """
    with file(scenario) as path:
        told = checked(path, isinstance(scenario, Mapping), settings({**(changes or {}), **more}))
    if told["problems"]:
        raise Problems([Problem(**problem) for problem in told["problems"]])
    return [warning["text"] for warning in told["warnings"]]


def checked(path: Optional[str], is_given: bool, arguments: list[str]) -> dict[str, Any]:
    """What `ttb check-scenario --json` says of a file."""
    done = call(["check-scenario", "--json", *arguments, *([path] if path else [])])
    if done.code not in (0, 2) or not done.output.strip():
        raise failure(done)
    told: dict[str, Any] = json.loads(done.output)
    for problem in told["problems"]:
        if is_given and problem["file"] == path:
            problem["file"] = GIVEN
    return told


def failure(done: Done) -> Failed:
    """The exception for a call that failed."""
    text = message(done.errors)
    if done.code == 2:
        return Problems([Problem("", "", line, "") for line in text.splitlines()])
    return Failed(text or f"ttb ended with exit code {done.code}", done.code)


def schema(of: str = "scenario") -> dict[str, Any]:
    """The JSON Schema of files: of a ``scenario``, of a ``bridge`` model, of a run's ``summary``, or of ``verdicts``."""
    kinds = {"scenario": [], "bridge": ["--bridge"], "summary": ["--summary"], "verdicts": ["--verdicts"]}
    if of not in kinds:
        raise ValueError(f"there is no schema of {of!r}; there are {', '.join(kinds)}")
    done = call(["schema", *kinds[of]])
    if done.code != 0:
        raise failure(done)
    found: dict[str, Any] = json.loads(done.output)
    return found
