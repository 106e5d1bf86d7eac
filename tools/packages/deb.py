"""The Debian package: the program, its manual pages, completions for shells."""

import gzip
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from .version import LICENSE, ROOT, SUMMARY, VERSION

CONTROL = """\
Package: ttb-cosim
Version: {version}
Architecture: amd64
Section: science
Priority: optional
Maintainer: The ttb developers <ttb@example.org>
Installed-Size: {size}
Depends: libc6 (>= {glibc})
Description: {summary}
 Vibrations of trains, tracks and bridges that act on each other: both sides
 are FMUs (FMI 2.0 co-simulation), coupled by iteration at every time step.
"""
COMPLETIONS = {
    "bash": "usr/share/bash-completion/completions/ttb",
    "zsh": "usr/share/zsh/vendor-completions/_ttb",
    "fish": "usr/share/fish/vendor_completions.d/ttb.fish",
}


def is_possible():
    return shutil.which("dpkg-deb") is not None


def make(program, target, output):
    """Writes the package; one for this machine alone is packed fast."""
    packing = ["-Zgzip", "-z1"] if target.triple is None else ["-Zxz"]
    with tempfile.TemporaryDirectory() as place:
        root = Path(place) / "root"
        installed = _put(root / "usr/bin/ttb", program.read_bytes(), 0o755)
        documents = root / "usr/share/doc/ttb-cosim"
        _put(documents / "copyright", LICENSE.read_bytes())
        _put(documents / "changelog.gz", gzip.compress((ROOT / "CHANGELOG.md").read_bytes(), mtime=0))
        for shell, path in COMPLETIONS.items():
            done = subprocess.run([installed, "completions", shell], check=True, capture_output=True)
            _put(root / path, done.stdout)
        pages = Path(place) / "man"
        pages.mkdir()
        subprocess.run([installed, "man", "-o", pages], check=True, stdout=subprocess.DEVNULL)
        for page in sorted(pages.iterdir()):
            _put(root / "usr/share/man/man1" / f"{page.name}.gz", gzip.compress(page.read_bytes(), mtime=0))
        size = sum(path.stat().st_size for path in root.rglob("*") if path.is_file()) // 1024
        control = CONTROL.format(version=VERSION, size=size, glibc=_glibc(installed), summary=SUMMARY)
        _put(root / "DEBIAN/control", control.encode())
        path = output / f"ttb-cosim_{VERSION}_amd64.deb"
        environment = dict(os.environ, SOURCE_DATE_EPOCH=os.environ.get("SOURCE_DATE_EPOCH", "315532800"))
        command = ["dpkg-deb", "--root-owner-group", *packing, "--build", root, path]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
        return path


def _put(path, content, mode=0o644):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    path.chmod(mode)
    return path


def _glibc(program):
    """The C library that the program wants, by its symbol versions, the highest GLIBC_2.N in it."""
    found = {int(part.split(b"\0")[0]) for part in program.read_bytes().split(b"GLIBC_2.")[1:] if part.split(b"\0")[0].isdigit()}
    return f"2.{max(found)}"
