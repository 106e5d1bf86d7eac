"""The recipe examples/import/calculix, end to end: input deck, CalculiX, matrices, where the track rests."""

import shutil

import pytest
from importing import beam, deflection, frequencies, recipe, table, triplets

bridge = recipe("calculix")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    assert shutil.which("ccx"), "CalculiX is missing (Debian: calculix-ccx)"
    folder = tmp_path_factory.mktemp("calculix")
    bridge.write(folder)
    return folder


@pytest.fixture(scope="module")
def matrices(folder):
    return triplets(folder / "bridge.sti"), triplets(folder / "bridge.mas")


@pytest.fixture(scope="module")
def rows(folder):
    """Row (from 0) by node.direction."""
    return {text.strip(): row for row, text in enumerate((folder / "bridge.dof").read_text().splitlines())}


def test_matrices_have_the_frequencies_that_calculix_prints(folder, matrices):
    printed = bridge.frequencies(folder)
    assert len(printed) == bridge.MODES
    found = frequencies(*matrices, len(printed))
    # The matrices are printed with fourteen digits, and a thin slab's K loses most of them in its first frequency.
    assert found == pytest.approx(printed, rel=2e-5)


def test_the_slab_bends_as_the_beam_of_r1(matrices):
    found = frequencies(*matrices, 5)
    # The fourth is the slab's lateral bending.
    assert found[[0, 1, 2, 4]] == pytest.approx([beam(bridge, n) for n in (1, 2, 3, 4)], rel=1e-3)
    assert found[0] == pytest.approx(beam(bridge, 1), rel=1e-4)


def test_the_mass_is_the_bridges(matrices, rows):
    mass = matrices[1]
    along = [row for label, row in rows.items() if label.endswith(".1")]
    # Those of the two nodes held at the begin are missing.
    assert mass[along][:, along].sum() == pytest.approx(bridge.MASS * bridge.LENGTH, rel=0.01)


def test_supports_rest_where_the_track_needs_them(folder, matrices, rows):
    supports = table(folder / "supports.csv")
    stations = sorted({float(line["x"]) for line in supports})
    assert stations == pytest.approx([0.65 * i for i in range(1, 50)])
    at = {int(line["node"]): float(line["x"]) for line in table(folder / "nodes.csv")}
    assert all(at[int(line["node"])] == pytest.approx(float(line["x"])) for line in supports)
    # A unit force in the middle: F L³ / 48 E I.
    middle = [line for line in supports if float(line["x"]) == 16.25]
    places = [rows[f"{line['node']}.3"] for line in middle]
    found = deflection(matrices[0], [float(line["weight"]) for line in middle], places)
    assert found == pytest.approx(bridge.LENGTH**3 / (48 * bridge.STIFFNESS), rel=1e-3)
