#!/usr/bin/env python3
"""A simply supported bridge in OpenSees: M and K, and where the track rests on them.

    pip install openseespy numpy
    python3 bridge.py FOLDER

50 plane beam elements: the bridge of examples/r1.json. x along the track, y up: the track's "down" is -y.

FOLDER then holds K.mtx, M.mtx (Matrix Market), dofs.csv, supports.csv, points.csv, and frequencies.csv with what OpenSees
itself finds.
"""

import argparse
import csv
import math
from pathlib import Path

import numpy
import openseespy.opensees as ops

LENGTH = 32.5  # m
STIFFNESS = 4.39668e11  # E I, N m²
MASS = 29720.0  # kg/m
AREA, MODULUS = 10.0, 3.45e10  # the area only serves the motion along x
ELEMENTS = 50
SPACING = LENGTH / ELEMENTS  # of the track's supports, m
MODES = 10
DIRECTIONS = ["x", "y", "rz"]  # of a node with three degrees of freedom


def build():
    """The model: nodes 1 to 51."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for i in range(ELEMENTS + 1):
        ops.node(i + 1, i * SPACING, 0.0)
    ops.fix(1, 1, 1, 0)
    ops.fix(ELEMENTS + 1, 0, 1, 0)
    ops.geomTransf("Linear", 1)
    for i in range(1, ELEMENTS + 1):
        inertia = STIFFNESS / MODULUS
        ops.element("elasticBeamColumn", i, i, i + 1, AREA, MODULUS, inertia, 1, "-mass", MASS, "-cMass")


def matrices():
    """K and M over the free degrees of freedom.

    The constraint handler must eliminate what is fixed (Plain or Transformation), and the numberer decides the order.
    """
    found = []
    for mass, stiffness in [(0.0, 1.0), (1.0, 0.0)]:
        build()
        ops.constraints("Transformation")
        ops.numberer("RCM")
        ops.system("FullGeneral")
        ops.algorithm("Linear")
        ops.integrator("GimmeMCK", mass, 0.0, stiffness)
        ops.analysis("Transient")
        if ops.analyze(1, 0.0) != 0:
            raise RuntimeError("OpenSees did not assemble the matrices")
        n = ops.systemSize()
        found.append(numpy.array(ops.printA("-ret")).reshape(n, n))
    return found


def market(path, matrix):
    """Writes the lower triangle as Matrix Market."""
    rows, columns = numpy.nonzero(numpy.tril(matrix))
    with open(path, "w") as file:
        file.write("%%MatrixMarket matrix coordinate real symmetric\n")
        file.write(f"{len(matrix)} {len(matrix)} {len(rows)}\n")
        for i, j in zip(rows, columns):
            file.write(f"{i + 1} {j + 1} {matrix[i, j]:.17g}\n")


def table(path, header, lines):
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([header, *lines])


def write(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    stiffness, mass = matrices()
    market(folder / "K.mtx", stiffness)
    market(folder / "M.mtx", mass)
    rows = []
    for node in ops.getNodeTags():
        x, y = ops.nodeCoord(node)
        rows += [[row + 1, node, d, x, y, 0.0] for row, d in zip(ops.nodeDOFs(node), DIRECTIONS) if row >= 0]
    table(folder / "dofs.csv", ["row", "node", "direction", "x", "y", "z"], sorted(rows))
    supports = [[round(i * SPACING, 9), i + 1, "y", -1] for i in range(1, ELEMENTS)]
    table(folder / "supports.csv", ["x", "node", "direction", "weight"], supports)
    points = [["mid", ELEMENTS // 2 + 1, "y", -1]]
    table(folder / "points.csv", ["name", "node", "direction", "weight"], points)

    build()
    found = [math.sqrt(value) / (2 * math.pi) for value in ops.eigen("-genBandArpack", MODES)]
    table(folder / "frequencies.csv", ["Hz"], [[f] for f in found])
    return found


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    print("Hz:", *(f"{f:.4f}" for f in write(parser.parse_args().folder)))
