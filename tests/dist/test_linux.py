"""What leaves the house for Linux: linked for glibc 2.17, so that it runs on systems of the last twelve years."""

import os
import re
import shutil
import subprocess
from functools import partial

import pytest
from conftest import EXAMPLES, REPOSITORY, has, host_run, only, venv_with
from elftools.elf.elffile import ELFFile
from elftools.elf.gnuversions import GNUVerNeedSection

OLDEST = (2, 17)
MB = 2**20


def highest_glibc(path):
    """The highest symbol version of the C library that a file wants."""
    with open(path, "rb") as file:
        sections = [section for section in ELFFile(file).iter_sections() if isinstance(section, GNUVerNeedSection)]
        names = [version.name for section in sections for _, versions in section.iter_versions() for version in versions]
    found = [re.fullmatch(r"GLIBC_(\d+)\.(\d+)(?:\.\d+)?", name) for name in names]
    return max((int(match[1]), int(match[2])) for match in found if match)


def needed(path):
    """Shared libraries that a file wants."""
    with open(path, "rb") as file:
        dynamic = ELFFile(file).get_section_by_name(".dynamic")
        return {tag.needed for tag in dynamic.iter_tags() if tag.entry.d_tag == "DT_NEEDED"}


def test_no_symbol_is_newer_than_glibc_2_17(program, fmus):
    """Of the program and of every library packed for Linux; nothing but the C library's own is needed."""
    for path in [program, *(fmu.library("linux64") for fmu in fmus.values())]:
        assert highest_glibc(path) <= OLDEST, path
        assert {name.split(".")[0] for name in needed(path)} <= {"libc", "libm", "libdl", "libpthread", "librt", "ld-linux-x86-64"}, path


def test_sizes(fmus, dist):
    """With all platforms inside."""
    assert fmus["Bridge"].path.stat().st_size <= 4 * MB
    assert fmus["TrainTrack"].path.stat().st_size <= 4 * MB
    assert all(path.stat().st_size <= 40 * MB for path in dist.iterdir())


def test_the_wheel_gives_the_bits_of_the_native_program(dist, r1, tmp_path):
    """Another linker, another C library to link against: results.csv byte for byte."""
    python = venv_with(only(dist, "*manylinux*.whl"), tmp_path / "venv")
    command = [python, "-c", "import sys, ttb; print(ttb.run(sys.argv[1], output=sys.argv[2]).summary['status'])"]
    command += [EXAMPLES / "r1.json", tmp_path / "out"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env={"PATH": "/nowhere"})
    assert done.stdout == "ok\n", done.stderr
    assert (tmp_path / "out/results.csv").read_bytes() == (r1 / "results.csv").read_bytes()


def test_the_libraries_run_in_a_host_in_c(fmus, linux_host):
    """With a URI for the resources and without."""
    for fmu in fmus.values():
        values = {host_run([linux_host], fmu, "linux64", uri) for uri in (f"file://{fmu.folder}/resources", "")}
        assert len(values) == 1


@pytest.mark.skipif(os.geteuid() != 0 or not has("debootstrap", "chroot", "unshare"), reason="needs root and debootstrap")
def test_debian_11_gives_the_bits_of_this_system(dist, r1):
    """glibc 2.31, Python 3.9: pip installs the wheel, R1 has the same results.csv, and `ttb check` finds both FMUs sound; the
    single file and the Debian package give the same. The chroot stays in target/debian11, or where $TTB_DEBIAN11 says."""
    root = REPOSITORY / os.environ.get("TTB_DEBIAN11", "target/debian11")
    if not (root / "usr/bin/pip3").exists():
        packages = "--include=python3,python3-venv,python3-pip"
        subprocess.run(["debootstrap", "--variant=minbase", packages, "bullseye", root], check=True, capture_output=True, timeout=900)
    place = root / "test"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir()
    for path in (EXAMPLES / "r1.json", *map(partial(only, dist), ("*manylinux*.whl", "*.deb", "ttb-*-linux-x86_64"))):
        shutil.copy(path, place)
    script = """set -e; cd /test; python3 -m venv venv; venv/bin/pip install --quiet --no-index *.whl
                venv/bin/ttb run r1.json --quiet -o wheel; venv/bin/python -c 'import ttb; print(ttb.__version__)'
                for fmu in TrainTrack Bridge; do venv/bin/ttb check wheel/$fmu.fmu; done
                ./ttb-*-linux-x86_64 run r1.json --quiet -o file
                dpkg --install *.deb >/dev/null; ttb run r1.json --quiet -o deb; dpkg --purge ttb-cosim >/dev/null"""
    # In a space of its own for mounts, so that /proc goes with the last process.
    enter = 'mount -t proc proc "$0/proc" && exec chroot "$0" sh -c "$1"'
    command = ["unshare", "--mount", "sh", "-c", enter, root.absolute(), script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    for way in ("wheel", "file", "deb"):
        assert (place / way / "results.csv").read_bytes() == (r1 / "results.csv").read_bytes(), way


def test_the_debian_package_installs_and_goes(dist, tmp_path):
    """By dpkg into a root of its own, without its scripts and triggers: the program runs from there, and all of it is removed."""
    package, root = only(dist, "*.deb"), tmp_path / "root"
    for folder in ("var/lib/dpkg/updates", "var/lib/dpkg/info"):
        (root / folder).mkdir(parents=True)
    (root / "var/lib/dpkg/status").touch()
    dpkg = ["dpkg", f"--root={root}", "--force-not-root", "--force-depends", "--log=/dev/null"]
    subprocess.run([*dpkg, "--install", package], check=True, capture_output=True, timeout=120)
    done = subprocess.run([root / "usr/bin/ttb", "--version"], check=True, capture_output=True, text=True)
    assert done.stdout.startswith("ttb ")
    subprocess.run([*dpkg, "--purge", "ttb-cosim"], check=True, capture_output=True, timeout=120)
    assert not (root / "usr/bin/ttb").exists()
