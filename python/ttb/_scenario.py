"""Scenarios and changes of them, as arguments of the program."""

from __future__ import annotations

import json
import os
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator, Mapping, Optional, Union

from ._program import AnyPath

Scenario = Union[None, AnyPath, Mapping[str, Any]]
GIVEN = "scenario"


def settings(changes: Mapping[str, Any]) -> list[str]:
    """``--set KEY=VALUE`` for each change; in a name of Python two underscores stand for a dot."""
    arguments = []
    for key, value in changes.items():
        arguments += ["--set", f"{key.replace('__', '.')}={json.dumps(plain(value))}"]
    return arguments


def plain(value: Any) -> Any:
    """Numbers of NumPy as numbers, arrays and tuples as lists, paths as texts."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return plain(value.tolist()) if hasattr(value, "tolist") else value


@contextmanager
def file(scenario: Scenario) -> Iterator[Optional[str]]:
    """The scenario as a file, None for the bundled one. A dictionary becomes a file in the current folder, if that can be
    written, so that the files it names are found beside it; it is removed at the end."""
    if scenario is None or not isinstance(scenario, Mapping):
        yield None if scenario is None else os.fspath(scenario)
        return
    folder = "." if os.access(".", os.W_OK) else None
    handle, name = tempfile.mkstemp(prefix=".ttb-", suffix=".json", dir=folder)
    try:
        with open(handle, "w", encoding="utf-8") as stream:
            json.dump(plain(scenario), stream)
        yield name
    finally:
        Path(name).unlink()
