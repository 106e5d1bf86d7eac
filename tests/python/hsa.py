"""The hybrid solution algorithm once more, in numpy over FMPy: what crates/coupling does, from its description.

Force compatibility at the supports: λ are the support forces, d the deck's displacements and velocities. One step:

    λ⁰ = λ_n + (λ_n − λ_{n−1})
    bridge      ← λ_n, (λ − λ_n)/h;   step;   d ← bridge
    train–track ← d_n, (d − d_n)/h;   step;   G ← train–track
    r = G − λ;   |r| ≤ tolerance · max(|G|, one axle load) → next step;   else λ ← λ + ω r, both states restored

with Aitken's ω in [0.05, 1]. Sums run from the first to the last entry, so that the numbers are the same to the bit.
"""

import numpy as np
from fmu import Reals

STATIC_TRIALS = 30


def dot(a, b):
    """Σ aᵢ bᵢ from left to right; numpy's own sums pair up."""
    return np.add.accumulate(a * b)[-1]


class Aitken:
    """Dynamic relaxation; ω lives on from step to step."""

    def __init__(self):
        self.omega = 1.0
        self.previous = None

    def update(self, trial, residual):
        """The next trial."""
        if self.previous is not None:
            change = residual - self.previous
            square = dot(change, change)
            if square > 0:
                self.omega *= -dot(self.previous, change) / square
        self.omega = min(max(self.omega, 0.05), 1.0)
        self.previous = residual
        return trial + self.omega * residual


class Coupling:
    """A train–track instance and a bridge instance in initialization mode, coupled by equal names."""

    def __init__(self, train_track, bridge, tolerance, axle_load, limit=30):
        forces, motions = bridge.fmu.names("input"), train_track.fmu.names("input")
        self.train_track, self.bridge = train_track, bridge
        self.force_in, self.motion_out = Reals(bridge, forces), Reals(bridge, motions)
        self.motion_in, self.force_out = Reals(train_track, motions), Reals(train_track, forces)
        self.tolerance, self.axle_load, self.limit = tolerance, axle_load, limit
        self.acceleration = Aitken()
        self.force = np.zeros(len(forces))
        self.change = np.zeros(len(forces))

    def initialise(self):
        """Static equilibrium of both together, then the end of initialization."""

        def trial(force):
            self.force_in.set(force)
            self.motion_in.set(self.motion_out.get())
            return self.force_out.get()

        self.force, iterations = self.iterate(trial, self.force, max(self.limit, STATIC_TRIALS))
        self.train_track.exitInitializationMode()
        self.bridge.exitInitializationMode()
        self.motion = self.motion_out.get()
        return iterations

    def step(self, t, h):
        """One macro step; returns the number of trials."""
        both = (self.train_track, self.bridge)
        states = [instance.getFMUstate() for instance in both]

        def trial(force):
            for instance, state in zip(both, states):
                instance.setFMUstate(state)
            self.force_in.set(self.force)
            self.force_in.set_rates((force - self.force) * (1 / h))
            self.bridge.doStep(t, h, False)
            motion = self.motion_out.get()
            self.motion_in.set(self.motion)
            self.motion_in.set_rates((motion - self.motion) * (1 / h))
            self.train_track.doStep(t, h, False)
            return self.force_out.get()

        force, iterations = self.iterate(trial, self.force + self.change, self.limit)
        self.change, self.force = force - self.force, force
        self.motion = self.motion_out.get()
        for instance, state in zip(both, states):
            instance.freeFMUstate(state)
        return iterations

    def iterate(self, trial, force, limit):
        """λ = G(λ): the converged λ and the number of trials."""
        self.acceleration.previous = None
        for iteration in range(1, limit + 1):
            answer = trial(force)
            residual = answer - force
            size = max(np.sqrt(dot(answer, answer)), self.axle_load)
            if np.sqrt(dot(residual, residual)) / size <= self.tolerance:
                return force, iteration
            force = self.acceleration.update(force, residual)
        raise AssertionError(f"no convergence in {limit} trials")
