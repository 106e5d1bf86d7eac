"""What the tests of imported matrices share: the recipes as modules, reading their files, frequencies by SciPy."""

import csv
import importlib.util
import math
from pathlib import Path

import numpy
import scipy.io
import scipy.sparse
import scipy.sparse.linalg

RECIPES = Path(__file__).resolve().parents[2] / "examples" / "import"


def recipe(name):
    """examples/import/NAME/bridge.py as a module."""
    spec = importlib.util.spec_from_file_location(f"recipe_{name}", RECIPES / name / "bridge.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def market(path):
    return scipy.io.mmread(path).tocsc()


def triplets(path):
    """CalculiX' one triangle, as a full matrix."""
    i, j, value = numpy.loadtxt(path, unpack=True)
    i, j = i.astype(int) - 1, j.astype(int) - 1
    n = max(i.max(), j.max()) + 1
    one = scipy.sparse.coo_matrix((value, (i, j)), shape=(n, n)).tocsc()
    return one + one.T - scipy.sparse.diags(one.diagonal())


def frequencies(stiffness, mass, count):
    """The lowest, Hz."""
    squares = scipy.sparse.linalg.eigsh(stiffness, count, mass.tocsc(), sigma=0.0, return_eigenvectors=False)
    return numpy.sqrt(numpy.sort(squares)) / (2 * math.pi)


def beam(recipe, mode):
    """Of the simply supported Euler-Bernoulli beam, Hz."""
    wave = mode * math.pi / recipe.LENGTH
    return wave**2 * math.sqrt(recipe.STIFFNESS / recipe.MASS) / (2 * math.pi)


def deflection(stiffness, weights, rows):
    """Displacement of the weighted rows under a unit force through the same weights, m/N."""
    w = numpy.zeros(stiffness.shape[0])
    for row, weight in zip(rows, weights):
        w[row] += weight
    return w @ scipy.sparse.linalg.spsolve(stiffness, w)
