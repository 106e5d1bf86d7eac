"""Tests of what leaves the house, as tools/dist makes it: tests/run dist, tests/run windows."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
HOSTS = Path(__file__).parent / "hosts"
EXAMPLES = REPOSITORY / "examples"


@pytest.fixture(scope="session")
def dist():
    """The folder that tools/dist has made: $TTB_DIST, or dist/."""
    folder = Path(os.environ.get("TTB_DIST", REPOSITORY / "dist"))
    if not (folder / "SHA256SUMS").is_file():
        pytest.exit(f"{folder} is missing: run tools/dist first, or tests/run dist", returncode=1)
    return folder


def only(folder, pattern):
    """The one file of that name, or a test that is skipped."""
    found = sorted(folder.glob(pattern))
    if not found:
        pytest.skip(f"tools/dist has left out {pattern}")
    assert len(found) == 1, f"{found}: empty {folder}, and call tools/dist again"
    return found[0]


@pytest.fixture(scope="session")
def program(dist):
    """The single file for Linux."""
    return only(dist, "ttb-*-linux-x86_64")


@pytest.fixture(scope="session")
def native():
    """The program of `cargo build --release`."""
    path = Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target")) / "release/ttb"
    if not path.is_file():
        pytest.exit(f"{path} is missing: run cargo build --release first", returncode=1)
    return path


@pytest.fixture(scope="session")
def r1(native, tmp_path_factory):
    """The folder of R1's results by the native program."""
    folder = tmp_path_factory.mktemp("r1")
    subprocess.run([native, "run", EXAMPLES / "r1.json", "-o", folder, "--quiet"], check=True, capture_output=True, timeout=60)
    return folder


@pytest.fixture(scope="session")
def fmus(program, tmp_path_factory):
    """Both FMUs of R1, built by the program that leaves the house."""
    folder = tmp_path_factory.mktemp("fmus")
    subprocess.run([program, "build", EXAMPLES / "r1.json", "-o", folder], check=True, capture_output=True, timeout=60)
    return {name: Packed(folder / f"{name}.fmu") for name in ("TrainTrack", "Bridge")}


class Packed:
    """An FMU, unpacked beside itself."""

    # What is set and what is read: a force on the bridge, the speed of the train.
    VARIABLES = {"Bridge": ("support[80].force", 1e5, "support[80].displacement"), "TrainTrack": ("support[80].displacement", 1e-4, "wheel[1].contact_force")}

    def __init__(self, path):
        self.path, self.name = path, path.stem
        self.folder = path.with_suffix("")
        with zipfile.ZipFile(path) as archive:
            archive.extractall(self.folder)
        root = ElementTree.parse(self.folder / "modelDescription.xml").getroot()
        self.guid = root.get("guid")
        self.references = {v.get("name"): v.get("valueReference") for v in root.iter("ScalarVariable")}

    def library(self, platform):
        return next((self.folder / "binaries" / platform).iterdir())

    def arguments(self):
        """INPUT, VALUE, OUTPUT for the hosts in C."""
        given, value, read = self.VARIABLES[self.name]
        references = self.references
        given = given if given in references else next(name for name in references if name.endswith(given.split(".")[1]))
        read = read if read in references else next(name for name in references if name.endswith(read.split(".")[1]))
        return [references[given], repr(value), references[read]]


@pytest.fixture(scope="session")
def linux_host(tmp_path_factory):
    """host.c for this system."""
    program = tmp_path_factory.mktemp("host") / "host"
    subprocess.run(["cc", "-O1", "-o", program, HOSTS / "host.c", "-ldl"], check=True)
    return program


def host_run(command, fmu, platform, uri):
    """What the host prints: version, status, the output twice."""
    line = [*command, fmu.library(platform), fmu.guid, uri, *fmu.arguments(), "5", "0.001"]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    version, status, once, again = done.stdout.split()
    assert (version, status) == ("2.0", "0") and once == again, "a step from a saved state gives the same bits"
    return float(once)


def venv_with(wheel, folder):
    """A fresh virtual environment with a wheel; its python."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True, timeout=60)
    pip = [sys.executable, "-m", "pip", "--python", folder / "bin/python", "install", "--quiet", "--no-index", "--disable-pip-version-check"]
    subprocess.run([*pip, wheel], check=True, timeout=60)
    return folder / "bin/python"


def has(*tools):
    return all(shutil.which(tool) for tool in tools)


@pytest.fixture(scope="session")
def wine(tmp_path_factory):
    """Runs a program under Wine, in a prefix that stays in target/wine."""
    prefix = (REPOSITORY / "target/wine").absolute()
    environment = dict(os.environ, WINEPREFIX=str(prefix), WINEDEBUG="-all", WINEDLLOVERRIDES="mscoree,mshtml,winedbg.exe=", LC_ALL="C.UTF-8")
    # By it programs for Windows tell that a shell of Unix has started them.
    environment.pop("SHELL", None)
    if not prefix.exists():
        prefix.parent.mkdir(exist_ok=True)
        subprocess.run(["wineboot", "--init"], check=True, env=environment, capture_output=True, timeout=300)

    def run(*command, expect=0, cwd=None, timeout=300):
        done = subprocess.run(["wine", *command], env=environment, cwd=cwd, capture_output=True, text=True, timeout=timeout, stdin=subprocess.DEVNULL)
        assert done.returncode == expect, f"{command} ended with {done.returncode}\n{done.stdout}{done.stderr}"
        return done

    run.environment = environment
    yield run
    subprocess.run(["wineserver", "--kill"], env=environment, timeout=60)
