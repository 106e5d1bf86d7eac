"""importers.py FOLDER: R1's FMUs in FMPy, validated and simulated each alone, and as a pair in ecos; the last values, as JSON."""

import ctypes
import json
import os
import sys
from pathlib import Path

from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

if os.name != "nt":
    # ecos for Linux wants it; the package tbb brings it.
    ctypes.CDLL(str(Path(sys.prefix) / "lib/libtbb.so.12"), mode=ctypes.RTLD_GLOBAL)
from ecospy import EcosSimulation, EcosSimulationStructure  # noqa: E402

# What is set on one alone, and what is watched.
ALONE = {"TrainTrack": ("support[20].displacement", 1e-4, "wheel[1].contact_force"), "Bridge": ("support[20].force", 1e5, "point[mid].displacement")}
H, STEPS = 1e-3, 1100


def in_fmpy(path, given, value, watched):
    problems = validate_fmu(path)
    assert problems == [], problems
    result = simulate_fmu(path, stop_time=0.1, step_size=H, start_values={given: value}, output=[watched])
    return result[watched][-1]


def in_ecos(paths, names):
    with EcosSimulationStructure() as structure:
        for fmu, path in paths.items():
            structure.add_model(fmu, path)
        for source, sink in (("TrainTrack", "Bridge"), ("Bridge", "TrainTrack")):
            for name in names[source]["output"] & names[sink]["input"]:
                structure.make_real_connection(f"{source}::{name}", f"{sink}::{name}")
        with EcosSimulation(structure=structure, step_size=H) as simulation:
            simulation.init()
            for _ in range(STEPS):
                simulation.step()
            values = [simulation.get_real(f"{fmu}::{watched}") for fmu, (_, _, watched) in ALONE.items()]
            simulation.terminate()
    return values


def main():
    folder = Path(sys.argv[1])
    paths = {fmu: str(folder / f"{fmu}.fmu") for fmu in ALONE}
    variables = {fmu: read_model_description(path).modelVariables for fmu, path in paths.items()}
    names = {fmu: {kind: {v.name for v in found if v.causality == kind} for kind in ("input", "output")} for fmu, found in variables.items()}
    values = [in_fmpy(paths[fmu], *alone) for fmu, alone in ALONE.items()] + in_ecos(paths, names)
    print(json.dumps([float(value) for value in values]))


main()
