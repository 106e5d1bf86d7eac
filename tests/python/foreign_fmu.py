"""A bridge FMU as others write them, foreign/beam.c: own names, own units, up positive, its own places, its own integrator."""

import io
import subprocess
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).with_name("foreign") / "beam.c"


@dataclass
class Beam:
    """A simply supported beam by its modes, points at x, m."""

    length: float
    stiffness: float  # N m2
    mass: float  # kg/m
    ratio: float  # damping of the first mode and of the second, Rayleigh
    points: np.ndarray
    modes: int = 40
    substeps: int = 1
    roll_back: bool = True
    velocities: bool = True
    crashes_at: float | None = None  # s
    hangs_at: float | None = None

    def write(self, folder, name="Deck"):
        """The FMU's path."""
        n = len(self.points)
        numbers = ",".join(repr(float(x)) for x in self.points)
        flags = {
            "POINTS": n,
            "MODES": self.modes,
            "SUBSTEPS": self.substeps,
            "LENGTH": self.length,
            "STIFFNESS": self.stiffness,
            "MASS": self.mass,
            "RATIO": self.ratio,
            "PLACES": numbers,
            **({} if self.roll_back else {"NO_STATES": 1}),
            **({} if self.crashes_at is None else {"CRASHES_AT": self.crashes_at}),
            **({} if self.hangs_at is None else {"HANGS_AT": self.hangs_at}),
        }
        library = Path(folder) / f"{name}.so"
        defines = [f"-D{key}={value}" for key, value in flags.items()]
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", *defines, "-o", library, SOURCE, "-lm"], check=True)
        path = Path(folder) / f"{name}.fmu"
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("modelDescription.xml", self.description())
            archive.write(library, "binaries/linux64/beam.so")
        return path

    def description(self):
        """Loads f[0…] in kN and deflections w_1 … in mm, both up; speeds in m/s; positions as outputs; EI and mass as parameters."""
        n = len(self.points)
        rows, outputs = [], []

        def add(name, reference, causality, kind, more=""):
            rows.append(f'<ScalarVariable name="{name}" valueReference="{reference}" causality="{causality}" {more}>{kind}</ScalarVariable>')
            if causality == "output":
                outputs.append(f'<Unknown index="{len(rows)}"/>')

        up = 'variability="continuous" description="positive up"'
        for i in range(n):
            add(f"f[{i}]", i, "input", '<Real unit="kN" start="0"/>', up)
        for i in range(n):
            add(f"w_{i + 1}", n + i, "output", '<Real unit="mm"/>', up)
        for i in range(n if self.velocities else 0):
            add(f"speed_{i + 1}", 2 * n + i, "output", '<Real unit="m/s"/>', up)
        for i in range(n):
            add(f"x{i + 1}", 3 * n + i, "output", '<Real unit="m"/>', 'variability="continuous"')
        fixed = 'variability="fixed" initial="exact"'
        add("Deck.EI", 4 * n, "parameter", f'<Real start="{self.stiffness}"/>', fixed)
        add("Deck.mu", 4 * n + 1, "parameter", f'<Real start="{self.mass}"/>', fixed)
        units = '<Unit name="kN"><BaseUnit kg="1" m="1" s="-2" factor="1000"/></Unit><Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit>'
        units += '<Unit name="m"><BaseUnit m="1"/></Unit><Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit>'
        state = f'canGetAndSetFMUstate="{str(self.roll_back).lower()}"'
        return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Deck" guid="deck-1" generationTool="by hand">
<CoSimulation modelIdentifier="beam" canHandleVariableCommunicationStepSize="true" {state}/>
<UnitDefinitions>{units}</UnitDefinitions><ModelVariables>{"".join(rows)}</ModelVariables>
<ModelStructure><Outputs>{"".join(outputs)}</Outputs><InitialUnknowns>{"".join(outputs)}</InitialUnknowns></ModelStructure>
</fmiModelDescription>"""
