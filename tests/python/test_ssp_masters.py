"""`ttb export-ssp --for …`: a sequential and an iterating master, written here after the usual ones, run what is exported for them.

`./tests/run python test_ssp_masters.py -s` prints the figures of docs/guide/ssp.md, "Which master is which".
"""

import re
import zipfile

import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssd
from fmpy.util import read_csv
from fmu import FMU2Instance, Fmu, Reals

H, STEPS = 1e-3, 1100
SIDES = ["TrainTrack", "Bridge"]
WATCHED = ["point[mid].displacement", "point[mid].velocity", "point[mid].acceleration"]
# Largest difference to the iterated run over the largest value of that, at most: of displacement and velocity; of the
# acceleration, at equal times where the force at the end of the step is known, else to the mean over the step.
SEQUENTIAL, ITERATING = "one-pass-sequential", "iterating"
MEAN, END, TO_END = ".mean_force", ".force", ".force, input_meaning of Bridge 2"
BOUNDS = {
    (SEQUENTIAL, MEAN): (3e-4, 5e-3),
    (ITERATING, MEAN): (2e-6, 2e-5),
    (ITERATING, TO_END): (2e-6, 2e-5),
}
OTHER = 2e-3  # what the displacement is off by at least with the force that the export does not connect
PASSES = 20


class System:
    """The two FMUs of a file, instantiated with the values that it binds, and connected as it says."""

    def __init__(self, path, folder, force):
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
            ssd = archive.read("SystemStructure.ssd").decode()
        self.sides = [FMU2Instance(Fmu(folder / "resources" / f"{name}.fmu"), name) for name in SIDES]
        self.bound = {}
        for name, side in zip(SIDES, self.sides):
            component = re.search(rf'<ssd:Component name="{name}".*?</ssd:Component>', ssd, flags=re.S)[0]
            for parameter, value in re.findall(r'<ssv:Parameter name="(\w+)">\s*<ssv:Integer value="(\d+)"/>', component):
                side.setInteger(side.fmu.references([parameter]), [int(value)])
                self.bound[f"{name}.{parameter}"] = int(value)
            if name == "Bridge" and force == TO_END:
                side.setInteger(side.fmu.references(["input_meaning"]), [2])
            side.setupExperiment(startTime=0.0)
            side.enterInitializationMode()
        connections = read_ssd(str(path)).system.connections
        self.wires = []
        for k, name in enumerate(SIDES):
            own = [c for c in connections if c.startElement == name]
            out = [c.startConnector for c in own]
            if k == 0:
                assert all(connector.endswith(MEAN) for connector in out)
                out = [connector.replace(MEAN, force.split(",")[0]) for connector in out]
            self.wires.append((Reals(self.sides[k], out), Reals(self.sides[1 - k], [c.endConnector for c in own])))
        self.watched = Reals(self.sides[1], WATCHED)
        for _ in range(PASSES):  # static equilibrium
            self.carry(0)
            self.carry(1)
        for side in self.sides:
            side.exitInitializationMode()

    def carry(self, k):
        """From a side to the other."""
        out, into = self.wires[k]
        into.set(out.get())

    def close(self):
        for side in self.sides:
            side.freeInstance()


def sequential(system, n):
    """Gauss–Seidel without iteration: train and track, then the bridge."""
    for k in (0, 1):
        system.sides[k].doStep(n * H, H)
        system.carry(k)


def iterating(system, n):
    """Gauss–Seidel with iteration: both sides step again from the begin of the step until the deck stays where it was."""
    states = [side.getFMUState() for side in system.sides]
    before = None
    for _ in range(PASSES):
        for side, state in zip(system.sides, states):
            side.setFMUState(state)
        if before is not None:
            system.wires[1][1].set(before)
        sequential(system, n)
        motion = system.wires[1][0].get()
        if before is not None and np.abs(motion - before).max() <= 1e-9 * np.abs(motion).max():
            break
        before = motion
    for side, state in zip(system.sides, states):
        side.freeFMUState(state)


def differences(system, step, r1_run):
    expected = read_csv(r1_run / "results.csv")
    rows = []
    for n in range(STEPS):
        step(system, n)
        rows.append(system.watched.get())
    system.close()
    rows = np.array(rows).T
    of = [(row, expected[name][1:]) for row, name in zip(rows, WATCHED)]
    of.append((rows[2], np.diff(expected[WATCHED[1]]) / H))
    return [np.abs(row - values).max() / np.abs(values).max() for row, values in of]


@pytest.mark.parametrize("master, step", [(SEQUENTIAL, sequential), (ITERATING, iterating)])
def test_a_master_is_as_far_from_the_iterated_run_as_the_guide_says(ttb, examples, r1_run, tmp_path, master, step):
    """With mean forces, as exported; with the forces at the ends of steps, held and as what they are."""
    path = tmp_path / "r1.ssp"
    ttb("export-ssp", examples / "r1.json", "--for", master, "-o", path)
    for force in (MEAN, END, TO_END):
        system = System(path, tmp_path / f"unpacked{force}", force)
        assert system.bound == ({"TrainTrack.input_meaning": 3} if master == ITERATING else {})
        found = differences(system, step, r1_run)
        shown = ", ".join(f"{100 * x:.4f} %" for x in found)
        print(f"\n{master:20} {force:32} displacement, velocity, acceleration, to its mean: {shown}", end="")
        of_motion, of_acceleration = BOUNDS.get((master, force), (np.inf, np.inf))
        assert max(found[:2]) <= of_motion and found[2 if force == TO_END else 3] <= of_acceleration
        assert force != END or found[0] >= OTHER


@pytest.mark.parametrize("master", [SEQUENTIAL, ITERATING])
def test_ttb_runs_what_is_exported_for_others_as_the_scenario(ttb, examples, r1_run, tmp_path, master):
    """Bit for bit: it takes the force that it needs, whichever is connected."""
    ttb("export-ssp", examples / "r1.json", "--for", master, "-o", tmp_path / "r1.ssp")
    ttb("run", tmp_path / "r1.ssp", "-o", tmp_path / "out")
    assert (tmp_path / "out" / "results.csv").read_bytes() == (r1_run / "results.csv").read_bytes()
