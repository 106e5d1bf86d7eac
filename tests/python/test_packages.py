"""The program is a single file, and its packages work where they are installed: nothing of the repository is beside them.

The packages are made of the program under test. Those that leave the house are linked otherwise (tools/dist): `tests/run dist`
tests them.
"""

import os
import shutil
import subprocess
import sys
import zipfile

import pytest
from conftest import REPOSITORY

FILES = ["results.csv", "summary.json", "TrainTrack.fmu", "Bridge.fmu"]


@pytest.fixture(scope="module")
def dist(ttb, tmp_path_factory):
    """Packages of the program under test."""
    folder = tmp_path_factory.mktemp("dist")
    command = [sys.executable, REPOSITORY / "tools/dist", "--program", ttb.path, "-o", folder]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture(scope="module")
def environment(dist, tmp_path_factory):
    """A virtual environment with the wheel alone."""
    place = tmp_path_factory.mktemp("venv")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", place], check=True, timeout=60)
    (wheel,) = dist.glob("*.whl")
    pip = [sys.executable, "-m", "pip", "--python", place / "bin/python", "install", "--quiet", "--no-index", "--disable-pip-version-check"]
    subprocess.run([*pip, wheel], check=True, timeout=60)
    return place


def runs_r1(program, r1_run, examples, folder):
    """R1 by another copy of the program, with an environment that leads nowhere: the same results."""
    folder.mkdir(exist_ok=True)
    command = [program, "run", examples / "r1.json", "--quiet"]
    done = subprocess.run(command, cwd=folder, env={"TMPDIR": str(folder)}, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    for name in FILES:
        assert (folder / "ttb-out" / name).is_file()
    assert (folder / "ttb-out/results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()


def test_the_program_works_wherever_it_is_moved(ttb, r1_run, examples, tmp_path):
    """The FMUs' libraries are inside."""
    moved = shutil.copy(ttb.path, tmp_path / "moved")
    runs_r1(moved, r1_run, examples, tmp_path / "here")


def test_the_wheel_runs_in_a_fresh_environment(environment, r1_run, examples, tmp_path):
    """`pip install ttb_cosim-….whl`, then `ttb run`."""
    runs_r1(environment / "bin/ttb", r1_run, examples, tmp_path / "here")


def test_python_finds_the_program_of_its_wheel(environment, tmp_path):
    """Without TTB and without a search path."""
    code = "import ttb, pathlib; print(ttb.program()); print(len(ttb.schema()['properties']), ttb.__version__)"
    command = [environment / "bin/python", "-c", code]
    done = subprocess.run(command, cwd=tmp_path, env={"PATH": "/nowhere"}, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    program, last = done.stdout.splitlines()
    assert os.path.samefile(program, environment / "bin/ttb")
    assert int(last.split()[0]) > 5


def test_pip_removes_all_that_the_wheel_has_brought(dist, tmp_path):
    """RECORD names every file with its hash; pip checks them."""
    (wheel,) = dist.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        assert archive.testzip() is None
        (record,) = [name for name in archive.namelist() if name.endswith("/RECORD")]
        listed = [line.rsplit(",", 2)[0] for line in archive.read(record).decode().splitlines()]
        assert sorted(listed) == sorted(archive.namelist())


@pytest.mark.skipif(shutil.which("dpkg-deb") is None, reason="dpkg-deb is missing")
def test_the_debian_package_holds_the_program_with_its_pages(dist, r1_run, examples, tmp_path):
    """Unpacked into a folder, as dpkg does."""
    (package,) = dist.glob("*.deb")
    root = tmp_path / "root"
    subprocess.run(["dpkg-deb", "--extract", package, root], check=True, timeout=60)
    for path in ["share/man/man1/ttb-run.1.gz", "share/bash-completion/completions/ttb", "share/doc/ttb-cosim/copyright"]:
        assert (root / "usr" / path).stat().st_size > 100
    runs_r1(root / "usr/bin/ttb", r1_run, examples, tmp_path / "here")


def test_checksums_fit(dist):
    """SHA256SUMS."""
    done = subprocess.run(["sha256sum", "--check", "--strict", "SHA256SUMS"], cwd=dist, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert len(done.stdout.splitlines()) == len(list(dist.iterdir())) - 1


def test_cargo_install_gives_a_program_that_works(ttb, r1_run, examples, tmp_path):
    """`cargo install --path master` from a checkout installs the program alone."""
    command = ["cargo", "install", "--path", REPOSITORY / "master", "--root", tmp_path, "--offline", "--locked", "--quiet"]
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    runs_r1(tmp_path / "bin/ttb", r1_run, examples, tmp_path / "here")
