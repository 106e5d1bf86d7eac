"""The version that all packages have, and texts that go into them."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MANIFEST = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]
VERSION = MANIFEST["version"]
LICENSE = ROOT / "LICENSE"
SUMMARY = "Train-track-bridge co-simulation: the program ttb and its Python interface"


def is_python_package_of_this_version():
    """Whether the Python package says the same version."""
    text = (ROOT / "python/ttb/__init__.py").read_text()
    return re.search(r'^__version__ = "(.+)"$', text, re.MULTILINE).group(1) == VERSION
