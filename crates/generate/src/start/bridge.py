"""A simply supported span in its first modes, as an FMU: the place for your own model.

    pip install pythonfmu numpy
    pythonfmu build -f bridge.py --handle-state --serialize-state --no-external-tool
    ttb check Bridge.fmu --preload libpython3.11.so.1.0
    ttb run scenario.json --bridge Bridge.fmu --map map.json --preload libpython3.11.so.1.0 --isolate

The master asks for little: forces at some stations in, displacements and velocities of the same stations out, and a state
that can be saved and restored. z points down, SI units. docs/guide/bridges.md says how other names, units and signs are
mapped, and what happens without states.
"""

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Real

LENGTH = @LENGTH@  # m
MASS = @MASS@  # kg/m
FIRST_FREQUENCY = @N0@  # Hz
DAMPING = 0.01  # of critical
MODES = 5
STATIONS = np.linspace(0.0, LENGTH, 21)[1:-1]  # m from the bridge's begin, bearings left out


class Bridge(Fmi2Slave):
    """q_j'' + 2 ζ ω_j q_j' + ω_j² q_j = Σ_i φ_j(x_i) F_i / m_j,   φ_j = sin(jπx/L),  ω_j = j² ω_1,  m_j = mL/2."""

    author = "you"
    description = "A simply supported span in its first modes"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        number = np.arange(1, MODES + 1)
        self.omega = 2 * np.pi * FIRST_FREQUENCY * number**2
        self.shapes = np.sin(np.pi * np.outer(STATIONS, number) / LENGTH)
        self.modal_mass = MASS * LENGTH / 2
        self.q, self.dq = np.zeros(MODES), np.zeros(MODES)
        self.F, self.w, self.dw = (np.zeros(len(STATIONS)) for _ in range(3))
        for i in range(len(STATIONS)):
            self.register_variable(Real(f"F{i + 1}", causality=Fmi2Causality.input, start=0.0, **self.entry("F", i)))
        for name in ("w", "dw"):
            for i in range(len(STATIONS)):
                self.register_variable(Real(f"{name}{i + 1}", causality=Fmi2Causality.output, **self.entry(name, i)))

    def entry(self, name, i):
        """A variable that is an entry of a vector."""
        return {"getter": lambda: float(getattr(self, name)[i]), "setter": lambda x: getattr(self, name).__setitem__(i, x)}

    def modal_force(self):
        return self.shapes.T @ self.F / self.modal_mass

    def show(self):
        self.w, self.dw = self.shapes @ self.q, self.shapes @ self.dq

    def exit_initialization_mode(self):
        """Static equilibrium under the forces set so far."""
        self.q, self.dq = self.modal_force() / self.omega**2, np.zeros(MODES)
        self.show()

    def do_step(self, current_time, step_size):
        """Trapezoidal rule for the mean velocity of the step; the force is held over it."""
        h, w = step_size, self.omega
        mean = (self.modal_force() + 2 / h * self.dq - w**2 * self.q) / (2 / h + 2 * DAMPING * w + h / 2 * w**2)
        self.q, self.dq = self.q + h * mean, 2 * mean - self.dq
        self.show()
        return True

    def _get_fmu_state(self):
        return {"q": self.q.copy(), "dq": self.dq.copy(), "F": self.F.copy()}

    def _set_fmu_state(self, state):
        self.q, self.dq, self.F = (state[name].copy() for name in ("q", "dq", "F"))
        self.show()
