#!/usr/bin/env python3
"""A simply supported bridge in CalculiX: M and K, and where the track rests on them.

    apt-get install calculix-ccx
    python3 bridge.py FOLDER

A slab of 50 solid elements with the stiffness and mass of the bridge of examples/r1.json. The slab is thin and its
modulus high, so that it bends as a beam without shear deformation; Poisson's ratio is 0. x along the track, z up.

FOLDER then holds bridge.sti, bridge.mas, bridge.dof (CalculiX' K, M and rows), nodes.csv, supports.csv, points.csv, and
modes.dat with the frequencies that CalculiX itself finds.
"""

import argparse
import csv
import subprocess
from pathlib import Path

LENGTH = 32.5  # m
STIFFNESS = 4.39668e11  # E I, N m²
MASS = 29720.0  # kg/m
WIDTH, DEPTH = 2.0, 0.2  # m
ELEMENTS = 50
SPACING = LENGTH / ELEMENTS  # of the track's supports, m
MODES = 10

MODULUS = STIFFNESS / (WIDTH * DEPTH**3 / 12)
DENSITY = MASS / (WIDTH * DEPTH)

# Corners and middles of edges of an element with 20 nodes, in halves of its size (CalculiX' order).
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
MIDDLES = [tuple((a + b) // 2 for a, b in zip(CORNERS[p], CORNERS[q])) for p, q in EDGES]


def mesh():
    """Elements as lists of node numbers, and the node number of every place (in halves of elements)."""
    number, elements = {}, []
    for e in range(ELEMENTS):
        places = [(2 * e + i, j, k) for i, j, k in CORNERS + MIDDLES]
        elements.append([number.setdefault(place, len(number) + 1) for place in places])
    return elements, number


def coordinates(place):
    i, j, k = place
    return i * SPACING / 2, (j - 1) * WIDTH / 2, (k - 1) * DEPTH / 2


def deck(elements, number, step):
    """Input of CalculiX."""
    lines = ["*NODE"]
    lines += [f"{n}, " + ", ".join(f"{x:.12g}" for x in coordinates(place)) for place, n in number.items()]
    lines.append("*ELEMENT, TYPE=C3D20, ELSET=SLAB")
    for e, nodes in enumerate(elements, 1):
        lines += [f"{e}, " + ", ".join(map(str, nodes[:10])) + ",", ", ".join(map(str, nodes[10:]))]
    lines += ["*MATERIAL, NAME=SLAB", "*ELASTIC", f"{MODULUS:.12e}, 0.", "*DENSITY", f"{DENSITY:.12e}"]
    lines += ["*SOLID SECTION, ELSET=SLAB, MATERIAL=SLAB", "*BOUNDARY"]
    # Bearings at half the depth, on both edges of either end.
    begin, end = 0, 2 * ELEMENTS
    lines += [f"{number[begin, j, 1]}, 1" for j in (0, 2)]
    lines += [f"{number[i, j, 1]}, 3" for i in (begin, end) for j in (0, 2)]
    lines += [f"{number[i, 0, 1]}, 2" for i in (begin, end)]
    lines += ["*STEP", step, str(MODES), "*END STEP", ""]
    return "\n".join(lines)


def table(path, header, lines):
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([header, *lines])


def write(folder, ccx="ccx"):
    """Runs CalculiX twice: for the matrices and for frequencies to compare with."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    elements, number = mesh()
    for job, step in [("bridge", "*FREQUENCY, SOLVER=MATRIXSTORAGE"), ("modes", "*FREQUENCY")]:
        (folder / f"{job}.inp").write_text(deck(elements, number, step))
        with open(folder / f"{job}.log", "w") as log:
            subprocess.run([ccx, job], cwd=folder, stdout=log, stderr=subprocess.STDOUT, check=True)

    table(folder / "nodes.csv", ["node", "x", "y", "z"], [[n, *coordinates(place)] for place, n in number.items()])
    # A support stands on both edges, half on each; z is up in CalculiX and down for the track.
    carriers = [(i, number[2 * i, j, 1]) for i in range(1, ELEMENTS) for j in (0, 2)]
    supports = [[round(i * SPACING, 9), node, "z", -0.5] for i, node in carriers]
    table(folder / "supports.csv", ["x", "node", "direction", "weight"], supports)
    middle = [["mid", number[ELEMENTS, j, 1], "z", -0.5] for j in (0, 2)]
    table(folder / "points.csv", ["name", "node", "direction", "weight"], middle)


def frequencies(folder):
    """Hz, as CalculiX prints them."""
    found = []
    for line in (Path(folder) / "modes.dat").read_text().splitlines():
        fields = line.split()
        if len(fields) == 5 and fields[0] == str(len(found) + 1):
            found.append(float(fields[3]))
        elif "P A R T I C I P A T I O N" in line:
            break
    return found


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--ccx", default="ccx", help="CalculiX' program")
    arguments = parser.parse_args()
    write(arguments.folder, arguments.ccx)
    print("Hz:", *(f"{f:.4f}" for f in frequencies(arguments.folder)))
