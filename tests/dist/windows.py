"""Helpers of the tests under Wine."""

import csv
import math
import os
import pty
import subprocess
import time

import pytest
from conftest import HOSTS, has

needs_wine = pytest.mark.skipif(not has("wine", "x86_64-w64-mingw32-gcc"), reason="mingw or Wine is missing")
# Largest difference between systems, relative to the largest value of a column.
SAME = 1e-6


def mingw(target, source, *options):
    """Compiles a program in C for Windows."""
    subprocess.run(["x86_64-w64-mingw32-gcc", "-O1", "-o", target, HOSTS / source, *options], check=True)
    return target


def type_ctrl_c(wine, results, *command):
    """The exit code of a program for Windows that runs in a terminal and gets Ctrl-C once it has written some results."""
    process, terminal = pty.fork()
    if process == 0:
        os.execvpe("wine", ["wine", *command], wine.environment)
    end = time.monotonic() + 60
    while not (results.is_file() and results.stat().st_size > 100_000) and time.monotonic() < end:
        time.sleep(0.1)
    os.write(terminal, b"\x03")
    code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    os.close(terminal)
    return code


def table(path):
    """Columns of a CSV file."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def assert_same(found, expected):
    """Same columns, same rows, and values as close as SAME, relative to the largest of the column."""
    found, expected = table(found), table(expected)
    assert list(found) == list(expected)
    for name, values in expected.items():
        size = max(map(abs, values))
        worst = max(abs(a - b) for a, b in zip(found[name], values, strict=True))
        assert worst <= SAME * size and math.isfinite(worst), f"{name}: {worst / size:.1e}"
