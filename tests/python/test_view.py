"""`ttb view`: files that a reader of VTK's formats takes, with the shapes and the crossing of the run."""

from xml.etree import ElementTree

import meshio
import numpy as np
import pandas
import pytest
from scenario import changed


def test_a_beam_has_its_sag_and_its_modes(ttb, examples, tmp_path):
    """R1: sag 5 m g L⁴ / 384 EI, first frequency π/(2 L²) √(EI/m), z up."""
    ttb("view", examples / "r1.json", "-o", tmp_path, "--modes", "2")
    mesh = meshio.read(tmp_path / "bridge.vtu")
    length, stiffness, mass = 32.5, 4.39668e11, 29720
    middle = np.argmin(np.abs(mesh.points[:, 0] - length / 2))
    sag = mesh.point_data["sag under own weight, m"]
    assert sag[middle, 2] == pytest.approx(-5 * mass * 9.81 * length**4 / 384 / stiffness, rel=1e-6)
    [first] = [name for name in mesh.point_data if name.startswith("mode 1, ")]
    hertz = np.pi / 2 / length**2 * np.sqrt(stiffness / mass)
    assert float(first.split()[2]) == pytest.approx(hertz, abs=1e-4)
    assert np.abs(mesh.point_data[first]).max() == pytest.approx(1.0)
    assert sum(len(block.data) for block in mesh.cells if block.type == "line") == 50


def test_shells_are_plates_and_a_model_file_needs_no_train(ttb, examples, tmp_path):
    """The box girder as scenario and as model."""
    for name in ("box-girder.json", "bridges/box-girder.json"):
        ttb("view", examples / name, "-o", tmp_path / name, "--modes", "1")
    scenario, model = (meshio.read(tmp_path / name / "bridge.vtu") for name in ("box-girder.json", "bridges/box-girder.json"))
    assert {block.type for block in model.cells} >= {"quad"}
    np.testing.assert_array_equal(scenario.points, model.points)
    for name, field in model.point_data.items():
        np.testing.assert_allclose(scenario.point_data[name], field, atol=1e-9)
    refused = ttb("view", examples / "bridges/box-girder.json", "--crossing", "-o", tmp_path / "no", expect=2)
    assert "a model file has no train" in refused.stderr


def test_the_crossing_is_that_of_the_run(ttb, examples, tmp_path):
    """The middle of the bridge moves as results.csv says, and as many wheelsets stand on it."""
    scenario = changed(examples / "r1.json", tmp_path / "s.json", {})
    ttb("run", scenario, "-o", tmp_path / "run")
    ttb("view", tmp_path / "run", "-o", tmp_path / "view", "--crossing", "--frames", "10", "--modes", "1")
    results = pandas.read_csv(tmp_path / "run" / "results.csv")
    grids = [dict(grid.attrib) for grid in ElementTree.parse(tmp_path / "view" / "crossing.pvd").iter("DataSet")]
    assert len(grids) == 22
    wheels = [name for name in results.columns if name.startswith("wheel[") and name.endswith(".position")]
    for bridge, train in zip(grids[::2], grids[1::2], strict=True):
        row = results.iloc[(results["time"] - float(bridge["timestep"])).abs().argmin()]
        mesh = meshio.read(tmp_path / "view" / bridge["file"])
        middle = np.argmin(np.abs(mesh.points[:, 0] - 16.25))
        moved = mesh.point_data["displacement, m"][middle, 2]
        assert moved == pytest.approx(-row["point[mid].displacement"], abs=1e-9)
        on_it = sum(39.65 < row[wheel] < 71.5 for wheel in wheels)
        file = ElementTree.parse(tmp_path / "view" / train["file"])
        assert abs(int(file.find(".//Piece").attrib["NumberOfPoints"]) - on_it) <= 1
