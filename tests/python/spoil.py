"""Copies of FMUs with something changed."""

import zipfile
from pathlib import Path

from fmu import Fmu

DESCRIPTION = "modelDescription.xml"


def copy(fmu, folder, changes):
    """A copy of an FMU in `folder`; `changes` maps a member's name to its new bytes from its old, or None to drop it."""
    target = Path(folder) / fmu.path.name
    with zipfile.ZipFile(fmu.path) as old, zipfile.ZipFile(target, "w") as new:
        for member in old.namelist():
            content = changes.get(member, lambda content: content)(old.read(member))
            if content is not None:
                new.writestr(member, content)
    return Fmu(target)


def replaced(old, new):
    """A change for `copy`: text that must occur, replaced once."""

    def change(content):
        assert old.encode() in content, old
        return content.replace(old.encode(), new.encode(), 1)

    return change
