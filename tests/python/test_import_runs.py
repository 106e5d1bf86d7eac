"""Bridges imported from CalculiX and OpenSees under R1's train: what the beam of R1 answers."""

import shutil

import pandas
import pytest
from importing import recipe

@pytest.fixture(scope="module", params=["calculix", "opensees"])
def imported(request, examples, tmp_path_factory):
    """A folder with the matrices and the scenario of examples/import."""
    folder = tmp_path_factory.mktemp(request.param)
    recipe(request.param).write(folder)
    shutil.copy(examples / "import" / request.param / "scenario.json", folder)
    return folder


def test_the_train_feels_the_beam_of_r1(imported, ttb, examples):
    """The same response as over the built-in elements, within 0.5 % of the greatest value at every instant."""
    ttb("run", imported / "scenario.json", "-o", imported / "out", "--quiet")
    ttb("run", examples / "r1.json", "-o", imported / "r1", "--quiet")
    theirs, ours = (pandas.read_csv(imported / run / "results.csv") for run in ("out", "r1"))
    for name in ("point[mid].displacement", "wheel[1].contact_force", "wheel[4].contact_force", "car[1].acceleration"):
        worst = (theirs[name] - ours[name]).abs().max() / ours[name].abs().max()
        print(f"{name}: {worst:.1e}")
        assert worst < 0.005, name
    name = "point[mid].acceleration"
    assert theirs[name].max() == pytest.approx(ours[name].max(), rel=0.01)


def test_a_look_at_the_bridge_shows_its_frequencies(imported, ttb):
    """The first is that of the beam, 5.7199 Hz."""
    shown = ttb("inspect-bridge", imported / "scenario.json").stdout
    line = next(line for line in shown.splitlines() if line.startswith("lowest frequencies"))
    assert float(line.split()[2].rstrip(",")) == pytest.approx(5.7199, rel=1e-3)
