"""`ttb run --bridge theirs.fmu --map map.json`: a bridge of other names, units and signs."""

import json
import re
import zipfile

import numpy as np
import pytest
from fmpy.util import read_csv
from spoil import DESCRIPTION


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
        ({"velocity": None}, "the map has no velocity"),
        ({"force": series("F_{i}", 0.0)}, "$.force: factor must be finite and not 0: 0"),
        ({"forces": series("F_{i}")}, "unknown field `forces`"),
    ],
)
def test_a_map_that_does_not_fit_is_refused(ttb, renamed, examples, tmp_path, change, message):
    path = write(tmp_path, {**MAP, **change})
    done = ttb("run", examples / "r1.json", "--bridge", renamed, "--map", path, "-o", tmp_path / "out", expect=2)
    assert message in done.stderr


def test_a_map_needs_a_bridge(ttb, examples, tmp_path):
    ttb("run", examples / "r1.json", "--map", write(tmp_path, MAP), expect=2)
