"""A bridge FMU that declares that it cannot save and restore its state: the same run, once a step, with an error estimate."""

import csv
import json

import numpy as np
import pytest
from fmpy.util import read_csv
from fmu import Fmu
from scenario import changed
from spoil import DESCRIPTION, copy, replaced

MID = "point[mid].displacement"


@pytest.fixture(scope="module")
def limited(r1, tmp_path_factory):
    """R1's bridge without roll-back, with and without directional derivatives."""

    def make(name, derivatives):
        changes = [replaced('canGetAndSetFMUstate="true"', 'canGetAndSetFMUstate="false"')]
        if not derivatives:
            changes.append(replaced('providesDirectionalDerivative="true"', 'providesDirectionalDerivative="false"'))

        def change(content):
            for one in changes:
                content = one(content)
            return content

        return copy(r1.bridge, tmp_path_factory.mktemp(name), {DESCRIPTION: change}).path

    return {True: make("derivatives", True), False: make("plain", False)}


@pytest.mark.parametrize("derivatives", [True, False], ids=["derivatives", "none"])
def test_it_steps_once_and_the_estimate_bounds_the_error(ttb, examples, r1_run, limited, tmp_path, derivatives):
    """Deflection against the iterated run; summary, iterations.csv and a warning say what was done."""
    said = ttb("run", examples / "r1.json", "--bridge", limited[derivatives], "-o", tmp_path)
    assert "cannot save and restore" in said.stderr and "NOT ITERATED" in said.stdout
    found = json.loads((tmp_path / "summary.json").read_text())
    coupling, iterations = found["coupling"], found["iterations"]
    assert (coupling["method"], iterations["explicit"], iterations["not_converged"]) == ("explicit", 1100, 0)
    # By derivatives or by trial instances of the FMU: the same number.
    assert coupling["contraction_at_start"] == pytest.approx(1.762e-3, rel=1e-3)
    iterated, once = (read_csv(folder / "results.csv")[MID] for folder in (r1_run, tmp_path))
    error = np.abs(once - iterated).max() / np.abs(iterated).max()
    assert 0 < error < coupling["error_estimate"] < 1e-4
    with open(tmp_path / "iterations.csv") as file:
        assert {(row["method"], row["iterations"], row["train_track_trials"]) for row in csv.DictReader(file)} == {("explicit", "1", "2")}


@pytest.mark.parametrize("derivatives", [True, False], ids=["derivatives", "none"])
def test_a_coupling_that_is_not_stable_without_it_ends_with_3(ttb, examples, tmp_path, derivatives):
    """The message has the contraction and advice, before the first step."""
    light = {"type": "beams", "spans": [{"length": 32.5, "bending_stiffness": 4.4e9, "mass": 300, "elements": 50}]}
    scenario = changed(examples / "r1.json", tmp_path / "light.json", {"bridge.structure": light, "time.step": 5e-3})
    ttb("build", scenario, "-o", tmp_path)
    flags = ["canGetAndSetFMUstate"] + ([] if derivatives else ["providesDirectionalDerivative"])

    def change(content):
        for flag in flags:
            content = replaced(f'{flag}="true"', f'{flag}="false"')(content)
        return content

    (tmp_path / "limited").mkdir()
    bridge = copy(Fmu(tmp_path / "Bridge.fmu"), tmp_path / "limited", {DESCRIPTION: change}).path
    said = ttb("run", scenario, "--bridge", bridge, "-o", tmp_path / "out", expect=3).stderr
    assert "not stable" in said and "ρ = " in said and "canGetAndSetFMUstate" in said
