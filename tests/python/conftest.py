"""The program under test, the FMUs it builds and a run of the published case R1."""

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
from fmu import Fmu
from scenario import changed

REPOSITORY = Path(__file__).resolve().parents[2]


def program_path():
    """$TTB, or where cargo puts the release build."""
    if "TTB" in os.environ:
        return Path(os.environ["TTB"])
    command = ["cargo", "metadata", "--no-deps", "--format-version", "1"]
    metadata = subprocess.run(command, cwd=REPOSITORY, check=True, capture_output=True).stdout
    return Path(json.loads(metadata)["target_directory"]) / "release" / "ttb"


class Program:
    """The command line program `ttb`."""

    def __init__(self, path):
        self.path = path

    def __call__(self, *arguments, expect=0, cwd=None):
        """Runs it; fails the test if it does not end with the exit code `expect`."""
        command = [self.path, *arguments]
        done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=300)
        assert done.returncode == expect, f"{command} ended with {done.returncode}\n{done.stdout}{done.stderr}"
        return done


@dataclass
class Pair:
    """Both FMUs of a scenario."""

    train_track: Fmu
    bridge: Fmu

    @classmethod
    def at(cls, folder):
        return cls(Fmu(folder / "TrainTrack.fmu"), Fmu(folder / "Bridge.fmu"))


@pytest.fixture(scope="session")
def ttb():
    path = program_path()
    if not path.is_file():
        pytest.exit(f"{path} is missing: run `cargo build --release` first, or tests/run python", returncode=1)
    return Program(path)


@pytest.fixture(scope="session")
def examples():
    return REPOSITORY / "examples"


@pytest.fixture(scope="session")
def r1(ttb, examples, tmp_path_factory):
    """The FMUs of examples/r1.json (docs/theory.md 15)."""
    folder = tmp_path_factory.mktemp("r1")
    ttb("build", examples / "r1.json", "-o", folder)
    return Pair.at(folder)


@pytest.fixture(scope="session")
def default(ttb, tmp_path_factory):
    """The FMUs of the bundled scenario."""
    folder = tmp_path_factory.mktemp("default")
    ttb("build", "-o", folder)
    return Pair.at(folder)


@pytest.fixture(scope="session")
def space_run(ttb, examples, tmp_path_factory):
    """The folder of `ttb run` of a short stretch of examples/space-manchester.json, results in `out`."""
    folder = tmp_path_factory.mktemp("space")
    (folder / "bridges").symlink_to(examples / "bridges")
    short = {"time.end": 0.08, "train.front_wheel": 62}
    scenario = changed(examples / "space-manchester.json", folder / "scenario.json", short)
    ttb("run", scenario, "-o", folder / "out", "--quiet", "--set", "output.supports=true")
    return folder


@pytest.fixture(scope="session")
def space(space_run):
    """The FMUs of that run: train, track and bridge in space."""
    return Pair.at(space_run / "out")


@pytest.fixture(scope="session", params=[f"{name} {side}" for name in ("r1", "default", "space") for side in ("train_track", "bridge")])
def any_fmu(request):
    """Each FMU in turn."""
    scenario, side = request.param.split()
    return getattr(request.getfixturevalue(scenario), side)


@pytest.fixture(scope="session", params=["train_track", "bridge"])
def fmu(request, r1):
    """Each FMU of R1 in turn."""
    return getattr(r1, request.param)


@pytest.fixture(scope="session")
def r1_run(ttb, examples, tmp_path_factory):
    """The folder of `ttb run examples/r1.json`."""
    folder = tmp_path_factory.mktemp("run")
    ttb("run", examples / "r1.json", "-o", folder)
    return folder
