"""The two stages: the FMUs' libraries for each system, then the program for each with all of them inside."""

import os
import platform
import shutil
import subprocess
import sys
import zipfile
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path

from .version import ROOT, VERSION

FMUS = {"TrainTrack": "fmu_train_track", "Bridge": "fmu_bridge"}
# An archive of the same libraries has the same bytes.
NO_DATE = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Target:
    """A system to build for."""

    system: str
    triple: str | None
    cargo: tuple
    build: str
    wheel_tag: str
    fmi: str
    library: str
    glibc: str = ""
    suffix: str = ""
    environment: tuple = ()


LINUX = Target(
    system="linux",
    triple="x86_64-unknown-linux-gnu",
    cargo=("cargo-zigbuild",),
    build="zigbuild",
    # The oldest glibc that Rust supports: that of RHEL 7, 2012.
    glibc=".2.17",
    wheel_tag="manylinux_2_17_x86_64.manylinux2014_x86_64",
    fmi="linux64",
    library="lib{}.so",
)
WINDOWS = Target(
    system="windows",
    triple="x86_64-pc-windows-gnu",
    cargo=("cargo",),
    build="build",
    wheel_tag="win_amd64",
    fmi="win64",
    library="{}.dll",
    suffix=".exe",
    # Without it ld keeps all that is linked, used or not: DLLs of 9 MB.
    environment=(("CARGO_PROFILE_RELEASE_LTO", "thin"),),
)
# A program built by the system's own compiler serves machines like this one.
HERE = replace(LINUX, triple=None, wheel_tag=f"linux_{platform.machine()}")


def possible(systems):
    """Targets that can be built here, and why the others cannot."""
    targets, left_out = [], []
    if "linux" in systems:
        if _runs("cargo-zigbuild", "--help") and _runs(sys.executable, "-m", "ziglang", "version"):
            targets.append(LINUX)
        else:
            left_out.append("Linux, glibc 2.17: pip install ziglang==0.15.2 cargo-zigbuild==0.24.1, and call tools/dist by that Python")
    if "windows" in systems:
        if shutil.which("x86_64-w64-mingw32-gcc") is None:
            left_out.append("Windows: apt-get install gcc-mingw-w64-x86-64")
        elif not (_sysroot() / "lib/rustlib/x86_64-pc-windows-gnu").is_dir():
            left_out.append("Windows: tools/std FOLDER x86_64-pc-windows-gnu, then PATH=FOLDER/toolchain/bin:$PATH")
        else:
            targets.append(WINDOWS)
    return targets, left_out


def _environment():
    """cargo-zigbuild, and the zig that it finds, are those of the Python that runs this."""
    return dict(os.environ, PATH=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))


def _runs(*command):
    try:
        return subprocess.run(command, capture_output=True, env=_environment()).returncode == 0
    except OSError:
        return False


def _sysroot():
    return Path(subprocess.run(["rustc", "--print", "sysroot"], check=True, capture_output=True, text=True).stdout.strip())


def programs(targets):
    """Both stages; a target and its program after the other."""
    for target in targets:
        _libraries(target)
    archive = _folder() / "dist" / "libraries.zip"
    archive.parent.mkdir(parents=True, exist_ok=True)
    _compress(targets, archive)
    for target in targets:
        _cargo(target, target.build, "--package", "ttb", libraries=archive)
        yield target, _built(target) / f"ttb{target.suffix}"


def _libraries(target):
    """The FMUs' shared libraries, in one command: what they share is then compiled once."""
    packages = [f"--package={crate.replace('_', '-')}" for crate in FMUS.values()]
    if not target.environment:
        _cargo(target, target.build, *packages)
        return
    for package in packages:
        # Each alone: together with the Rust library that others link it would not be optimised as a whole.
        _cargo(target, "rustc", package, "--crate-type", "cdylib")


def _folder():
    return Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).absolute()


def _built(target):
    """Where cargo puts things."""
    return _folder() / target.triple / "release"


def _cargo(target, *arguments, libraries=None):
    """Builds for a target, with libraries inside."""
    environment = dict(_environment(), CARGO_TARGET_DIR=str(_folder()), **dict(target.environment))
    if libraries:
        environment["TTB_LIBRARIES"] = str(libraries)
    command = [*target.cargo, arguments[0], "--release", "--locked", "--target", target.triple + target.glibc, *arguments[1:]]
    print("tools/dist:", *command, file=sys.stderr)
    subprocess.run(command, cwd=ROOT, env=environment, check=True)


def _compress(targets, archive):
    """The libraries of all FMUs and systems, under the names they get in the FMUs. The same archive is not written again: each
    program would be built anew."""
    packed = BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as zip:
        for fmu, crate in FMUS.items():
            for target in targets:
                built = _built(target) / "deps" / target.library.format(crate)
                entry = zipfile.ZipInfo(f"binaries/{target.fmi}/{fmu}{built.suffix}", NO_DATE)
                entry.compress_type = zipfile.ZIP_DEFLATED
                entry.external_attr = 0o100644 << 16
                zip.writestr(entry, built.read_bytes(), compresslevel=9)
    if not archive.is_file() or archive.read_bytes() != packed.getvalue():
        archive.write_bytes(packed.getvalue())


def single_file(program, target, output):
    """The program alone, which is all that is needed to run it."""
    name = f"ttb-{VERSION}-{target.system}-{platform.machine()}{target.suffix}"
    return Path(shutil.copy(program, output / name))
