"""System structures (SSP 1.0): R1 as .ssp in ttb and in the masters of other people, foreign systems, broken ones.

`./tests/run python test_ssp.py -k one_pass -s` prints the differences that docs/guide/ssp.md states.
"""

import ctypes
import io
import re
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd
from fmpy.util import read_csv
from spoil import DESCRIPTION

H, STEPS, END = 1e-3, 1100, 1.1
SSD = "SystemStructure.ssd"
DISPLACEMENT, ACCELERATION = "point[mid].displacement", "point[mid].acceleration"
# Largest difference to the iterated run over the largest value of that, at most (docs/guide/ssp.md): at equal times; with
# the run in one pass taken so many steps earlier, where it is late; of the largest values.
BOUNDS = {DISPLACEMENT: (0.005, 0.5, 1e-3, 1e-4), ACCELERATION: (0.2, 1, 5e-3, 1e-3)}


@pytest.fixture(scope="session")
def r1_ssp(ttb, examples, tmp_path_factory):
    """R1 as a system structure."""
    path = tmp_path_factory.mktemp("ssp") / "r1.ssp"
    done = ttb("export-ssp", examples / "r1.json", "-o", path)
    assert done.stdout.strip() == str(path)
    return path


def rewritten(source, target, ssd=lambda text: text, members=None):
    """A copy of an .ssp whose document has gone through `ssd`; `members` as for spoil.copy, of all other members."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        for member in old.namelist():
            change = (lambda b: ssd(b.decode()).encode()) if member == SSD else (members or {}).get(member, lambda b: b)
            content = change(old.read(member))
            if content is not None:
                new.writestr(member, content)
    return target


def test_the_structure_fits_the_schema_and_says_what_is_connected(r1_ssp, examples):
    """FMPy validates by the XSD of SSP 1.0; every input is driven by the output of its name."""
    read = read_ssd(str(r1_ssp), validate=True)
    train_track, bridge = read.system.elements
    assert (train_track.name, bridge.name, read.version) == ("TrainTrack", "Bridge", "1.0")
    forces = [c for c in read.system.connections if c.startElement == "TrainTrack"]
    assert len(forces) == 49 and len(read.system.connections) == 3 * 49
    assert all(c.startConnector == c.endConnector and c.endConnector.endswith("].force") for c in forces)
    assert {u.name for u in read.units} >= {"N", "m", "m/s"}
    with zipfile.ZipFile(r1_ssp) as archive:
        assert archive.namelist() == [SSD, "resources/TrainTrack.fmu", "resources/Bridge.fmu", "extra/org.ttb/scenario.json"]
        assert archive.read("extra/org.ttb/scenario.json") == (examples / "r1.json").read_bytes()


def test_the_same_scenario_gives_the_same_bytes(ttb, examples, r1_ssp, tmp_path):
    """The default name is the scenario's, in the current folder."""
    ttb("export-ssp", examples / "r1.json", cwd=tmp_path)
    assert (tmp_path / "r1.ssp").read_bytes() == r1_ssp.read_bytes()


def test_a_run_of_the_structure_is_the_run_of_the_scenario(ttb, r1_ssp, r1_run, tmp_path):
    """Bit for bit."""
    ttb("run", r1_ssp, "-o", tmp_path)
    assert (tmp_path / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
    summary = (tmp_path / "summary.json").read_text()
    assert '"system_sha256"' in summary and '"scenario_sha256"' not in summary


def in_fmpy(path):
    """FMPy's fixed-step loop (Jacobi). Its times are those at the beginning of each step."""
    result = simulate_ssp(str(path), stop_time=END - H / 2, step_size=H)
    return {name: result[f"Bridge.{name}"] for name in BOUNDS}


def in_libcosim(path):
    """libcosim with the algorithm the document names for it."""
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.ERROR)
    execution = CosimExecution.from_ssp_file(str(path))
    bridge = execution.slave_index_from_instance_name("Bridge")
    references = {v.name.decode(): v.reference for v in execution.slave_variables(bridge)}
    observer = CosimObserver.create_time_series(STEPS + 1)
    assert execution.add_observer(observer)
    for name in BOUNDS:
        assert observer.start_time_series(bridge, references[name], CosimVariableType.REAL)
    assert execution.step(STEPS)
    return {name: observer.time_series_real_samples(bridge, references[name], 1, STEPS)[2] for name in BOUNDS}


def in_ecos(path):
    """ecos; its library wants libtbb.so.12, which the package tbb brings."""
    ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libtbb.so.12"), mode=ctypes.RTLD_GLOBAL)
    from ecospy import EcosSimulation

    series = {name: [] for name in BOUNDS}
    with EcosSimulation(ssp_path=str(path), step_size=H) as simulation:
        simulation.init()
        for _ in range(STEPS):
            simulation.step()
            for name, values in series.items():
                values.append(simulation.get_real(f"Bridge::{name}"))
        simulation.terminate()
    return series


@pytest.mark.parametrize("master", [in_fmpy, in_libcosim, in_ecos])
def test_one_pass_masters_are_as_far_from_the_iterated_run_as_the_guide_says(master, r1_ssp, r1_run):
    """Displacement and acceleration of the deck, over the whole run and at their peaks."""
    iterated = read_csv(r1_run / "results.csv")
    times, differences = iterated["time"][1:], []
    for name, series in master(r1_ssp).items():
        values, expected, largest = np.array(series), iterated[name][1:], np.abs(iterated[name]).max()
        assert len(values) == STEPS
        at_once, late, shifted, peak = BOUNDS[name]
        earlier = np.interp(times[:-1] + late * H, times, values)
        found = [np.abs(values - expected).max(), np.abs(earlier - expected[:-1]).max(), np.abs(values).max() - largest]
        found = np.array(found) / largest
        print(f"\n{master.__name__[3:]:9} {name:24} {100 * found[0]:7.3f} %, {late} steps earlier {100 * found[1]:6.3f} %, ", end="")
        print(f"largest value {100 * found[2]:+.4f} %", end="")
        differences.append(np.abs(found) <= [at_once, shifted, peak])
    assert np.all(differences)


def foreign(ssd):
    """Other names, the bridge first, wrong units in the bridge's description that factors put right, no settings."""
    ssd = re.sub(r"<ssd:Annotations>.*?</ssd:Annotations>", "", ssd, flags=re.S)
    ssd = ssd.replace('"TrainTrack"', '"Zug"').replace('"Bridge"', '"Brücke"')
    components = re.findall(r" *<ssd:Component .*?</ssd:Component>\n", ssd, flags=re.S)
    assert len(components) == 2
    bridge = re.sub(r"support\[(\d+)\]\.force", r"F_\1", components[1]).replace(' unit="N"', "")
    bridge = re.sub(r"support\[(\d+)\]\.displacement(\" kind=\"\w+\">\s*<ssc:Real) unit=\"m\"", r"uz_\1\2", bridge)
    ssd = ssd.replace("".join(components), bridge + components[0])

    def connection(match):
        text = re.sub(r'endConnector="support\[(\d+)\]\.force"', r'endConnector="F_\1"', match[0])
        text = re.sub(r'startConnector="support\[(\d+)\]\.displacement"', r'startConnector="uz_\1"', text)
        if text == match[0]:
            return text
        return text[:-2] + '><ssc:LinearTransformation factor="1000.0"/></ssd:Connection>'

    return re.sub(r"<ssd:Connection [^>]*/>", connection, ssd)


def foreign_bridge(fmu):
    """Bridge.fmu under other names: F_i said to be in kN, uz_i said to be in mm."""
    target = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(fmu)) as old, zipfile.ZipFile(target, "w") as new:
        for member in old.namelist():
            content = old.read(member)
            if member == DESCRIPTION:
                xml = content.decode()
                xml = re.sub(r'name="support\[(\d+)\]\.force"', r'name="F_\1"', xml)
                xml = re.sub(r'name="support\[(\d+)\]\.displacement"', r'name="uz_\1"', xml)
                xml = re.sub(r'(name="F_\d+".*?unit=)"N"', r'\1"kN"', xml, flags=re.S)
                xml = re.sub(r'(name="uz_\d+".*?unit=)"m"', r'\1"mm"', xml, flags=re.S)
                units = '<UnitDefinitions><Unit name="kN"><BaseUnit kg="1" m="1" s="-2" factor="1000"/></Unit>'
                units += '<Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit>'
                content = xml.replace("<UnitDefinitions>", units).encode()
            new.writestr(member, content)
    return target.getvalue()


def test_a_foreign_structure_is_wired_by_its_connections(ttb, r1_ssp, r1_run, tmp_path):
    """Units are converted (kN, mm), then factors applied; without an annotation the documented defaults hold."""
    members = {"resources/Bridge.fmu": foreign_bridge}
    path = rewritten(r1_ssp, tmp_path / "foreign.ssp", foreign, members)
    ttb("run", path, "-o", tmp_path / "out")
    values, expected = read_csv(tmp_path / "out" / "results.csv"), read_csv(r1_run / "results.csv")
    for name in BOUNDS:
        assert np.abs(values[name] - expected[name]).max() <= 1e-5 * np.abs(expected[name]).max(), name


FIRST = r"<ssd:Connection [^>]*/>"


def dropped(pattern, count=1):
    return lambda ssd: re.sub(pattern, "", ssd, count=count)


def doubled(ssd):
    return re.sub(FIRST, lambda m: m[0] * 2, ssd, count=1)


def swapped(old, new):
    def change(ssd):
        assert old in ssd, old
        return ssd.replace(old, new, 1)

    return change


DRIVES_TRAIN = r'<ssd:Connection startElement="Bridge" startConnector="support\[7\]\.velocity"[^>]*/>'
DRIVES_BRIDGE = r'<ssd:Connection startElement="TrainTrack" startConnector="support\[7\]\.force"[^>]*/>'
BOMB = '<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">' + "".join(f'<!ENTITY a{i} "{"&a;" * 10}">' for i in range(9)) + "]>"
BROKEN = {
    "bad XML": (swapped("</ssd:Elements>", ""), "is not well-formed"),
    "entity bomb": (swapped("<ssd:SystemStructureDescription", BOMB + "<ssd:SystemStructureDescription"), "document type"),
    "unknown component": (swapped('endElement="Bridge"', 'endElement="Brigde"'), "Connection[1]: there is no component Brigde"),
    "unknown connector": (swapped('endConnector="support[1].force"', 'endConnector="f"'), "Bridge has no connector f"),
    "connector not in the FMU": (swapped('name="point[mid].moment"', 'name="point[mid].m"'), "has no variable of this name"),
    "unconnected input": (dropped(DRIVES_TRAIN), "[@name='TrainTrack']: no connection drives the input support[7].velocity"),
    "lost force": (dropped(DRIVES_BRIDGE), "the output support[7].force (and 0 more) is not connected to Bridge"),
    "double connection": (doubled, "Connection[2]: support[1].force is driven already, by Connection[1]"),
    "unit mismatch": (
        swapped('endConnector="support[1].displacement"', 'endConnector="support[1].velocity"'),
        "support[1].displacement is in m, support[1].velocity in m/s",
    ),
    "unit unlike the FMU's": (swapped('<ssc:Real unit="N"', '<ssc:Real unit="m"'), "is in m here, but in N in the FMU"),
    "source outside": (swapped('source="resources/Bridge.fmu"', 'source="../Bridge.fmu"'), "leads out of the archive"),
    "no such source": (swapped("resources/Bridge.fmu", "resources/B.fmu"), "the archive has no file resources/B.fmu"),
    "one component": (dropped(r'(?s)<ssd:Component name="Bridge".*?</ssd:Component>'), "1 components; there must be two"),
    "unknown element": (swapped("</ssd:Elements>", '<ssd:Robot name="R"/></ssd:Elements>'), "[@name='R']: an element Robot is not known"),
    "setting": (swapped('method="auto"', 'method="magic"'), "/Coupling/@method: "),
    "start": (swapped('startTime="0.0"', 'startTime="1"'), "/DefaultExperiment/@startTime: is 1; runs start at 0"),
    "wrong way": (swapped('endElement="Bridge"', 'endElement="TrainTrack"'), "support[1].force is no input but an output"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_structure_is_refused_with_its_place(ttb, r1_ssp, tmp_path, name):
    """Exit code 2, nothing written."""
    change, said = BROKEN[name]
    path = rewritten(r1_ssp, tmp_path / "broken.ssp", change)
    done = ttb("run", path, "-o", tmp_path / "out", expect=2)
    assert said in done.stderr and f"{path}/{SSD}: " in done.stderr
    assert not (tmp_path / "out").exists()


def test_all_problems_come_at_once(ttb, r1_ssp, tmp_path):
    """Five of the table in one document."""
    names = ["unknown component", "connector not in the FMU", "unit unlike the FMU's", "start", "setting"]

    def all_of_them(ssd):
        for name in reversed(names):
            ssd = BROKEN[name][0](ssd)
        return ssd

    path = rewritten(r1_ssp, tmp_path / "broken.ssp", all_of_them)
    done = ttb("run", path, "-o", tmp_path / "out", expect=2)
    assert len(done.stderr.strip().splitlines()) >= len(names)
    for place in ("Connection[1]: ", "@startTime: ", "@method: ", "point[mid].m']: "):
        assert place in done.stderr


def test_archives_that_are_none_or_hostile_are_refused(ttb, r1_ssp, tmp_path):
    """No zip, no document, a path out of the archive, an option that belongs to scenarios."""
    path = tmp_path / "a.ssp"
    path.write_text("no zip")
    assert "zip archive" in ttb("run", path, expect=2).stderr
    rewritten(r1_ssp, path, members={"resources/Bridge.fmu": lambda _: None})
    assert "the archive has no file resources/Bridge.fmu" in ttb("run", path, expect=2).stderr
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("resources/a.txt", "")
    assert f"has no {SSD}" in ttb("run", path, expect=2).stderr
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("../evil", "")
    assert "leads out of the archive" in ttb("run", path, expect=2).stderr
    assert "belong to a scenario" in ttb("run", r1_ssp, "--bridge", path, expect=2).stderr
    assert not list(tmp_path.glob("ttb-out"))
