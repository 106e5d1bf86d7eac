"""Both FMUs in an FMPy loop with roll-back, written in Python, give the master's result: iterations and every bit.

So the master does nothing that another master cannot do with the same FMUs.
"""

import csv

import numpy as np
import pytest
from conftest import Pair
from fmpy.util import read_csv
from fmu import FMU2Instance
from hsa import Coupling
from scenario import changed

H = 1e-3
TOLERANCE = 1e-8
# The ICE 3 trailer (docs/theory.md 15), N, in the order of operations of the program.
AXLE_LOAD = 9.81 * (0.25 * 44_000 + 0.5 * 2_400 + 2_400)
# R1 as published, and on a bridge of 1 t/m, where the iteration has work to do: end, s, and the span's data.
CASES = {
    "R1": (1.1, {"length": 32.5, "bending_stiffness": 4.39668e11, "mass": 29720, "elements": 50}),
    "R1 on a light bridge": (0.5, {"length": 32.5, "bending_stiffness": 2e10, "mass": 1000, "elements": 50}),
}


@pytest.fixture(scope="module", params=CASES.values(), ids=CASES)
def master(ttb, examples, tmp_path_factory, request):
    """The folder of the master's run; both FMUs are in it."""
    end, span = request.param
    folder = tmp_path_factory.mktemp("master")
    changes = {
        "time.end": end,
        "bridge.structure": {"type": "beams", "spans": [span]},
        "coupling": {"method": "aitken", "tolerance": TOLERANCE},
    }
    ttb("run", changed(examples / "r1.json", folder / "r1.json", changes), "-o", folder)
    return folder


@pytest.fixture(scope="module")
def results(master):
    """results.csv, read by FMPy's own reader."""
    return read_csv(master / "results.csv")


@pytest.fixture(scope="module")
def loop(master, results):
    """Names and rows of all recorded outputs, and the iterations of every step."""
    pair, steps = Pair.at(master), len(results) - 1
    with FMU2Instance(pair.train_track) as train_track, FMU2Instance(pair.bridge) as bridge:
        for instance in (train_track, bridge):
            instance.setupExperiment(startTime=0.0, stopTime=steps * H)
            instance.enterInitializationMode()
        coupling = Coupling(train_track, bridge, TOLERANCE, AXLE_LOAD)
        recorded = [(i, name) for i in (train_track, bridge) for name in i.fmu.names("output") if not name.startswith("support[")]

        def row():
            return [instance.get(name) for instance, name in recorded]

        coupling.initialise()
        rows, iterations = [row()], []
        for n in range(steps):
            iterations.append(coupling.step(n * H, H))
            rows.append(row())
    return [name for _, name in recorded], np.array(rows), iterations


def test_the_loop_needs_the_masters_iterations_in_every_step(loop, master):
    """iterations.csv has one row a step."""
    with open(master / "iterations.csv") as file:
        iterations = [int(row["iterations"]) for row in csv.DictReader(file)]
    assert loop[2] == iterations
    assert len(set(iterations)) > 1


def test_the_loop_gives_the_masters_numbers_to_the_last_bit(loop, results):
    """The 17 digits of results.csv stand for exactly one number; times are written in their shortest form."""
    names, rows, _ = loop
    assert results.dtype.names == ("time", *names)
    assert results["time"][:-1].tolist() == [float(f"{n * H:.15g}") for n in range(len(results) - 1)]
    different = {name: np.abs(results[name] - column).max() for name, column in zip(names, rows.T) if (results[name] != column).any()}
    assert different == {}
