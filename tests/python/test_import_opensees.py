"""The recipe examples/import/opensees, end to end: model, OpenSees, matrices, where the track rests."""

import pytest
from importing import beam, deflection, frequencies, market, recipe, table

bridge = recipe("opensees")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("opensees")
    bridge.write(folder)
    return folder


@pytest.fixture(scope="module")
def matrices(folder):
    return market(folder / "K.mtx"), market(folder / "M.mtx")


def test_matrices_have_the_frequencies_that_opensees_finds(folder, matrices):
    found = frequencies(*matrices, bridge.MODES)
    theirs = [float(line["Hz"]) for line in table(folder / "frequencies.csv")]
    assert found == pytest.approx(theirs, rel=1e-7)


def test_the_bridge_is_the_beam_of_r1(matrices):
    found = frequencies(*matrices, 4)
    # The third is along the track.
    assert found[[0, 1, 3]] == pytest.approx([beam(bridge, n) for n in (1, 2, 3)], rel=1e-5)


def test_the_mass_is_the_bridges(folder, matrices):
    dofs = table(folder / "dofs.csv")
    assert [int(line["row"]) for line in dofs] == list(range(1, 151))
    along = [int(line["row"]) - 1 for line in dofs if line["direction"] == "x"]
    mass = matrices[1].tocsr()[along][:, along].sum()
    # The node held at the begin is missing: 2/6 and 2·1/6 of an element.
    assert mass == pytest.approx(bridge.MASS * (bridge.LENGTH - 2 / 3 * bridge.SPACING))


def test_supports_rest_where_the_track_needs_them(folder, matrices):
    supports = table(folder / "supports.csv")
    assert [float(line["x"]) for line in supports] == pytest.approx([0.65 * i for i in range(1, 50)])
    rows = {(line["node"], line["direction"]): line for line in table(folder / "dofs.csv")}
    for line in supports:
        dof = rows[line["node"], line["direction"]]
        assert float(dof["x"]) == pytest.approx(float(line["x"]))
    middle = next(line for line in supports if float(line["x"]) == 16.25)
    row = int(rows[middle["node"], middle["direction"]]["row"]) - 1
    found = deflection(matrices[0], [float(middle["weight"])], [row])
    assert found == pytest.approx(bridge.LENGTH**3 / (48 * bridge.STIFFNESS), rel=1e-9)
