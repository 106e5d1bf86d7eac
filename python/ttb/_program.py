"""Where the program ``ttb`` is, and how it is called."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
from functools import lru_cache
from importlib import metadata
from pathlib import Path
from typing import NamedTuple, Sequence, Union

DISTRIBUTION = "ttb-cosim"
NAME = "ttb.exe" if os.name == "nt" else "ttb"
AnyPath = Union[str, "os.PathLike[str]"]


class Done(NamedTuple):
    """How a call ended."""

    code: int
    output: str
    errors: str


def program() -> Path:
    """Path of the program: ``$TTB``, or the one that was installed with this package, or the one on the search path.

    Raises FileNotFoundError if there is none.
    """
    given = os.environ.get("TTB")
    if given:
        return Path(given)
    found = _installed() or shutil.which(NAME)
    if found is None:
        raise FileNotFoundError(f"{NAME} is neither installed with {DISTRIBUTION} nor on the search path; the variable TTB may name it")
    return Path(found)


@lru_cache(maxsize=1)
def _installed() -> Path | None:
    """The script of this distribution, wherever pip has put it."""
    try:
        files = metadata.files(DISTRIBUTION) or []
    except metadata.PackageNotFoundError:
        return None
    paths = (Path(str(file.locate())) for file in files if file.name == NAME)
    return next((path.resolve() for path in paths if path.is_file()), None)


def call(arguments: Sequence[AnyPath]) -> Done:
    """Calls the program and waits for its end.

    Ctrl-C ends the program after the step at hand: only then KeyboardInterrupt goes on.
    """
    command = [str(program()), *(os.fspath(argument) for argument in arguments)]
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, text=True, encoding="utf-8", errors="replace", **pipes) as process:
        try:
            output, errors = process.communicate()
        except BaseException:
            if process.poll() is None:
                process.send_signal(signal.SIGTERM) if os.name == "nt" else process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    return Done(process.returncode, output, errors)
