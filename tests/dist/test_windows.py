"""What leaves the house for Windows, under Wine: no real Windows was at hand."""

import json
import math
import subprocess
import sys
import zipfile

import pytest
from conftest import EXAMPLES, REPOSITORY, host_run, only
from windows import SAME, assert_same, mingw, needs_wine, type_ctrl_c

pytestmark = needs_wine
# What every Windows has, since 10.
OF_THE_SYSTEM = {"kernel32.dll", "ntdll.dll", "msvcrt.dll", "advapi32.dll", "userenv.dll", "ws2_32.dll", "bcryptprimitives.dll", "bcrypt.dll", "shell32.dll", "ole32.dll"}


@pytest.fixture(scope="session")
def scripts(dist, tmp_path_factory):
    """The folder of programs of the wheel for Windows, installed by pip, with the library that Wine 8 lacks."""
    place = tmp_path_factory.mktemp("Python 3")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--disable-pip-version-check"]
    subprocess.run([*pip, "--platform=win_amd64", "--target", place, only(dist, "*win_amd64.whl")], check=True, timeout=60)
    folder = place / "bin"
    mingw(folder / "bcryptprimitives.dll", "bcryptprimitives.c", "-shared", "-ladvapi32")
    return folder


@pytest.fixture(scope="session")
def ttb(wine, scripts):
    """ttb.exe."""
    return lambda *arguments, **options: wine(scripts / "ttb.exe", *arguments, **options)


@pytest.fixture(scope="session")
def windows_host(scripts):
    return mingw(scripts / "host.exe", "host.c")


def test_the_libraries_need_nothing_but_windows(fmus, scripts):
    """No libgcc, no winpthread, no runtime of another compiler; all functions of FMI 2.0 are there."""
    for path in [scripts / "ttb.exe", *(fmu.library("win64") for fmu in fmus.values())]:
        lines = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", path], check=True, capture_output=True, text=True).stdout.splitlines()
        names = {line.split(":", 1)[1].strip().lower() for line in lines if "DLL Name:" in line}
        assert {name for name in names if not name.startswith("api-ms-win-")} <= OF_THE_SYSTEM, path
        functions = {line.split()[-1] for line in lines if line.split() and line.split()[-1].startswith("fmi2")}
        assert path.suffix == ".exe" or len(functions) == 44


@pytest.mark.parametrize("name", ["Bridge", "TrainTrack"])
def test_a_library_runs_in_a_host_in_c_as_on_linux(name, fmus, wine, windows_host, linux_host):
    """Resources by URI, and beside the library; loaded and unloaded several times."""
    fmu = fmus[name]
    expected = host_run([linux_host], fmu, "linux64", "")
    line = [windows_host, f"Z:{fmu.library('win64')}", fmu.guid]
    for uri in (f"file:///Z:{fmu.folder}/resources", ""):
        version, status, once, again = wine(*line, uri, *fmu.arguments(), "5", "0.001").stdout.split()
        assert (version, status, once) == ("2.0", "0", again)
        assert math.isclose(float(once), expected, rel_tol=1e-9)


def test_libcosim_for_windows_runs_both_fmus(fmus, wine, scripts, linux_host, tmp_path):
    """The build that its developers publish, made by another compiler."""
    place = REPOSITORY / "target/libcosim-windows"
    if not list(place.glob("*.whl")):
        command = ["python3", "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", "--platform=win_amd64", "--dest", place, "libcosimpy==0.0.6"]
        if subprocess.run(command, capture_output=True, timeout=300).returncode != 0:
            pytest.skip("libcosimpy for Windows cannot be had")
    with zipfile.ZipFile(next(place.glob("*.whl"))) as archive:
        for name in archive.namelist():
            if name.endswith(".dll"):
                (tmp_path / name.rsplit("/", 1)[1]).write_bytes(archive.read(name))
    (tmp_path / "bcryptprimitives.dll").write_bytes((scripts / "bcryptprimitives.dll").read_bytes())
    host = mingw(tmp_path / "cosim.exe", "cosim.c")
    for fmu in fmus.values():
        # The host in C takes one step more.
        done = wine(host, f"Z:{fmu.path}", *fmu.arguments(), "6", "1000000", cwd=tmp_path)
        # Its library writes what it does before it.
        assert math.isclose(float(done.stdout.splitlines()[-1]), host_run([linux_host], fmu, "linux64", ""), rel_tol=1e-9)


@pytest.mark.parametrize("option", [[], ["--isolate=both"]], ids=["in one process", "isolated"])
def test_r1_has_the_results_of_linux(option, ttb, r1, tmp_path):
    """`ttb.exe run`."""
    ttb("run", EXAMPLES / "r1.json", "-o", tmp_path, "--quiet", *option)
    assert_same(tmp_path / "results.csv", r1 / "results.csv")


def test_fmus_built_on_windows_are_those_built_on_linux(ttb, fmus, tmp_path):
    """The same program inside, the same scenario: byte for byte."""
    ttb("build", EXAMPLES / "r1.json", "-o", tmp_path)
    for fmu in fmus.values():
        assert (tmp_path / fmu.path.name).read_bytes() == fmu.path.read_bytes()


def test_the_check_finds_both_fmus_sound(ttb, fmus):
    """`ttb.exe check`."""
    for fmu in fmus.values():
        ttb("check", fmu.path)


def test_a_sweep_gives_the_tables_of_linux(ttb, program, tmp_path):
    """`ttb.exe sweep`: workers, journal, tables."""
    arguments = ["sweep", EXAMPLES / "r1.json", "--trains", "ice2", "--speeds", "150:300:25", "--way", "modal", "--quiet"]
    ttb(*arguments, "-o", tmp_path / "windows")
    subprocess.run([program, *arguments, "-o", tmp_path / "linux"], check=True, capture_output=True, timeout=120)
    found, expected = ((tmp_path / system / "peaks.csv").read_text().splitlines() for system in ("windows", "linux"))
    assert len(found) == len(expected) > 8
    for a, b in zip(found, expected):
        for x, y in zip(a.split(","), b.split(","), strict=True):
            assert x == y or math.isclose(float(x), float(y), rel_tol=SAME)


def test_problems_and_exit_codes_are_those_of_linux(ttb, tmp_path):
    """Paths of Windows in a message."""
    (tmp_path / "bad.json").write_text('{"trac": 1}')
    done = ttb("check-scenario", tmp_path / "bad.json", expect=2)
    assert "did you mean `track`?" in done.stderr


def test_an_fmu_that_crashes_is_told_and_results_are_kept(ttb, fmus, tmp_path):
    """A library that reads at address 0, in a process of its own: exit code 4."""
    broken = tmp_path / "Broken.fmu"
    library = mingw(tmp_path / "Bridge.dll", "crash.c", "-shared")
    with zipfile.ZipFile(fmus["Bridge"].path) as old, zipfile.ZipFile(broken, "w") as new:
        for name in old.namelist():
            new.writestr(name, library.read_bytes() if name.endswith(".dll") else old.read(name))
    done = ttb("run", EXAMPLES / "r1.json", "--bridge", broken, "--isolate", "-o", tmp_path / "out", expect=4)
    assert "access violation" in done.stderr


@pytest.mark.parametrize("option", [[], ["--isolate=both"]], ids=["in one process", "isolated"])
def test_ctrl_c_keeps_the_results_so_far(option, wine, scripts, tmp_path):
    """Exit code 130."""
    code = type_ctrl_c(wine, tmp_path / "results.csv", scripts / "ttb.exe", "run", "-o", tmp_path, "--quiet", *option)
    assert code == 130
    assert json.loads((tmp_path / "summary.json").read_text())["status"] == "interrupted"
    assert (tmp_path / "results.csv").read_text().count("\n") > 10


def test_sizes(fmus, dist):
    """With the libraries of both systems inside."""
    assert all((fmu.folder / "binaries/win64").is_dir() and fmu.path.stat().st_size <= 4 * 2**20 for fmu in fmus.values())
    assert all(path.stat().st_size <= 40 * 2**20 for path in dist.iterdir())
