"""`ttb run --bridge theirs.fmu --map map.json`: a bridge of other names, units and signs."""

import json
import re
import zipfile

import numpy as np
import pytest
from fmpy.util import read_csv
from spoil import DESCRIPTION, copy


@pytest.fixture(scope="module")
def renamed(r1, tmp_path_factory):
    """R1's Bridge.fmu under other names; its numbers stay SI and positive down."""
    path = tmp_path_factory.mktemp("renamed") / "Deck.fmu"
    with zipfile.ZipFile(r1.bridge.path) as old, zipfile.ZipFile(path, "w") as new:
        for member in old.namelist():
            content = old.read(member)
            if member == DESCRIPTION:
                xml = content.decode()
                for what, name in (("force", "F"), ("displacement", "uz"), ("velocity", "vz")):
                    xml = re.sub(rf'name="support\[(\d+)\]\.{what}"', lambda m: f'name="{name}_{int(m[1]) - 1}"', xml)
                content = xml.encode()
            new.writestr(member, content)
    return path


def series(name, factor=1.0):
    return {"name": name, "first": 0, "factor": factor}


MAP = {"force": series("F_{i}"), "displacement": series("uz_{i}"), "velocity": series("vz_{i}")}


def write(folder, content):
    path = folder / "map.json"
    path.write_text(json.dumps(content))
    return path


def test_other_names_give_the_same_run(ttb, renamed, r1_run, examples, tmp_path):
    ttb("run", examples / "r1.json", "--bridge", renamed, "--map", write(tmp_path, MAP), "-o", tmp_path / "out", "--quiet")
    found, expected = read_csv(tmp_path / "out" / "results.csv"), read_csv(r1_run / "results.csv")
    for name in ("point[mid].displacement", "point[mid].acceleration", "wheel[1].contact_force"):
        assert np.array_equal(found[name], expected[name]), name


def test_factors_turn_signs_and_units(ttb, renamed, r1_run, examples, tmp_path):
    """Both signs turned: the bridge is the same seen from below. Factors of two are exact."""
    turned = {"force": series("F_{i}", -2.0), "displacement": series("uz_{i}", -2.0), "velocity": series("vz_{i}", -2.0)}
    ttb("run", examples / "r1.json", "--bridge", renamed, "--map", write(tmp_path, turned), "-o", tmp_path / "out", "--quiet")
    found, expected = read_csv(tmp_path / "out" / "results.csv"), read_csv(r1_run / "results.csv")
    name = "wheel[1].contact_force"
    assert np.abs(found[name] / expected[name] - 1).max() < 1e-9
    assert np.abs(found["point[mid].displacement"] + 2 * expected["point[mid].displacement"]).max() < 1e-9 * 1e-3


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"force": series("G_{i}")}, "no input G_0, input G_1"),
        ({"displacement": series("uz")}, "$.displacement: name must contain {i}: `uz`"),
        ({"supports": [1, 48]}, "the bridges have 48 supports of the track's 49"),
        ({"displacement": {"names": ["uz_0", "uz_1"]}}, "the map names 2 of its 49 displacements"),
        ({"stations": [0.0, 10.0, 20.0]}, "19 supports stand outside its stations, which reach from 0 m to 20 m"),
        ({"stations": {"from": 0.0, "spacing": 0.0}}, "$.stations: spacing must be positive: 0"),
        ({"parameters": {"stifness_factor": 2}}, "no variable `stifness_factor` (did you mean `stiffness_factor`?)"),
        ({"parameters": {"stiffness_factor": "two", "uz_0": 1}}, "stiffness_factor is a Real, not \"two\""),
        ({"force": series("F_{i}", 0.0)}, "$.force: factor must be finite and not 0: 0"),
        ({"forces": series("F_{i}")}, "$.forces: unknown key: `forces` (did you mean `force`?)"),
    ],
)
def test_a_map_that_does_not_fit_is_refused(ttb, renamed, examples, tmp_path, change, message):
    path = write(tmp_path, {**MAP, **change})
    done = ttb("run", examples / "r1.json", "--bridge", renamed, "--map", path, "-o", tmp_path / "out", expect=2)
    assert message in done.stderr


def test_lists_of_names_and_units_that_are_declared_need_no_factor(ttb, r1, r1_run, examples, tmp_path):
    """Forces in kN and displacements in mm, as the description says: the same run, to rounding."""
    xml = {}

    def in_kilonewtons(content):
        text = re.sub(r'(name="support\[\d+\]\.force".*?unit=)"N"', r'\1"kN"', content.decode(), flags=re.S)
        unit = '<UnitDefinitions><Unit name="kN"><BaseUnit kg="1" m="1" s="-2" factor="1000"/></Unit>'
        xml["text"] = text.replace("<UnitDefinitions>", unit)
        return xml["text"].encode()

    theirs = copy(r1.bridge, tmp_path, {DESCRIPTION: in_kilonewtons}).path
    names = [f"support[{i}].force" for i in range(1, 50)]
    # What the description says is not what the bridge does: the probe finds the difference, and names the factor.
    said = ttb("run", examples / "r1.json", "--bridge", theirs, "-o", tmp_path / "out", expect=2).stderr
    assert '"force" (support[1].force …): "factor": 1e0' in said
    right = write(tmp_path, {"force": {"names": names, "factor": 1.0}})
    ttb("run", examples / "r1.json", "--bridge", theirs, "--map", right, "-o", tmp_path / "out", "--quiet")
    found, expected = read_csv(tmp_path / "out" / "results.csv"), read_csv(r1_run / "results.csv")
    assert np.array_equal(found["wheel[1].contact_force"], expected["wheel[1].contact_force"])


def test_parameters_reach_the_fmu(ttb, r1, r1_run, examples, tmp_path):
    """A deck twice as stiff deflects half as much; an empty map means our own names."""
    stiff = write(tmp_path, {"parameters": {"stiffness_factor": 2.0, "mass_factor": 1.0}})
    ttb("run", examples / "r1.json", "--bridge", r1.bridge.path, "--map", stiff, "-o", tmp_path / "out", "--quiet")
    sag = [read_csv(folder / "results.csv")["point[mid].displacement"].max() for folder in (tmp_path / "out", r1_run)]
    assert sag[0] / sag[1] == pytest.approx(0.5, abs=0.03)


def test_a_map_needs_a_bridge(ttb, examples, tmp_path):
    ttb("run", examples / "r1.json", "--map", write(tmp_path, MAP), expect=2)
