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
# s. On Windows Ctrl-C and the interruption of a notebook are noticed between waits, elsewhere at once.
WAIT = 0.2 if os.name == "nt" else None
# Calls that last, of all threads, and have not been asked to end.
_running: set[subprocess.Popen[str]] = set()


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

    KeyboardInterrupt ends the program after the step at hand, as Ctrl-C does: only then it goes on.
    """
    command = [str(program()), *(os.fspath(argument) for argument in arguments)]
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, text=True, encoding="utf-8", errors="replace", **pipes) as process:
        _running.add(process)
        try:
            output, errors = _printed(process)
        except BaseException:
            _ask_to_end(process)
            _printed(process)
            raise
        finally:
            _running.discard(process)
    return Done(process.returncode, output, errors)


def end_calls() -> None:
    """Asks all calls of this Python, in whatever thread, to end after the step at hand."""
    while _running:
        _ask_to_end(_running.pop())


def _printed(process: subprocess.Popen[str]) -> tuple[str, str]:
    """What a process has written into its pipes, once it has ended."""
    while True:
        try:
            return process.communicate(timeout=WAIT)
        except subprocess.TimeoutExpired:
            pass


def _ask_to_end(process: subprocess.Popen[str]) -> None:
    """As Ctrl-C does. On Windows, where signals cannot be sent, the program waits for an event with its number."""
    if os.name != "nt":
        process.send_signal(signal.SIGINT)
        return
    import ctypes

    kernel = ctypes.WinDLL("kernel32")
    kernel.OpenEventW.restype = ctypes.c_void_p
    modify = 2
    event = ctypes.c_void_p(kernel.OpenEventW(modify, False, f"Local\\ttb-end-{process.pid}"))
    if event:
        kernel.SetEvent(event)
        kernel.CloseHandle(event)
    else:
        # It has not begun to listen, nor to compute.
        process.terminate()
