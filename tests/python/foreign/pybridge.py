"""A bridge for PythonFMU: a simply supported beam of Euler–Bernoulli elements by Newmark's rule, in NumPy.

Forces on and motions of the points 0.65 m, 1.30 m, … of a span of 32.5 m, N and m, positive down; Rayleigh damping.
`STATES` stands for a model whose author has written state hooks; without them PythonFMU saves declared variables only.
"""

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

LENGTH, POINTS, RATIO, STATES = 32.5, 49, 0.05, True


class PyBridge(Fmi2Slave):
    """Inputs F1 …, outputs u1 …, v1 …; parameters EI and mass."""

    author = "the tests"
    description = "A beam in NumPy"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.EI, self.mass = 4.39668e11, 29720.0
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        self.register_variable(Real("EI", **fixed))
        self.register_variable(Real("mass", **fixed))
        self.F, self.U, self.V = np.zeros(POINTS), np.zeros(POINTS), np.zeros(POINTS)
        for i in range(POINTS):
            self.register_variable(Real(f"F{i + 1}", causality=Fmi2Causality.input, start=0.0, **self.at("F", i)))
        for name, values in (("u", "U"), ("v", "V")):
            for i in range(POINTS):
                self.register_variable(Real(f"{name}{i + 1}", causality=Fmi2Causality.output, **self.at(values, i)))
        self.h = 0.0

    def at(self, name, i):
        """A variable that lives in a vector."""
        return {"getter": lambda: float(getattr(self, name)[i]), "setter": lambda x: getattr(self, name).__setitem__(i, x)}

    def exit_initialization_mode(self):
        n = POINTS + 1
        l = LENGTH / n
        k = np.array([[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l], [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
        m = np.array([[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l], [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
        K, M = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
        for e in range(n):
            own = slice(2 * e, 2 * e + 4)
            K[own, own] += self.EI / l**3 * k
            M[own, own] += self.mass * l / 420 * m
        free = [i for i in range(2 * n + 2) if i not in (0, 2 * n)]
        self.K, self.M = K[np.ix_(free, free)], M[np.ix_(free, free)]
        self.points = [free.index(2 * i) for i in range(1, n)]
        w1 = np.sqrt(np.min(np.linalg.eigvals(np.linalg.solve(self.M, self.K)).real))
        w2 = 4 * w1
        self.C = 2 * RATIO / (w1 + w2) * (w1 * w2 * self.M + self.K)
        self.q, self.dq = np.linalg.solve(self.K, self.load()), np.zeros(len(free))
        self.show()

    def load(self):
        """The forces on all degrees of freedom."""
        f = np.zeros(len(self.K))
        f[self.points] = self.F
        return f

    def show(self):
        """Motion of the points."""
        self.U, self.V = self.q[self.points].copy(), self.dq[self.points].copy()

    def do_step(self, t, h):
        if h != self.h:
            self.inverse = np.linalg.inv(2 / h * self.M + self.C + h / 2 * self.K)
            self.h = h
        # Trapezoidal rule for the mean velocity, the force held.
        mean = self.inverse @ (self.load() + 2 / h * self.M @ self.dq - self.K @ self.q)
        self.q, self.dq = self.q + h * mean, 2 * mean - self.dq
        self.show()
        return True

    if STATES:

        def _get_fmu_state(self):
            return {"q": self.q.copy(), "dq": self.dq.copy(), "F": self.F.copy()} if hasattr(self, "q") else {}

        def _set_fmu_state(self, state):
            if state:
                self.q, self.dq, self.F = (state[key].copy() for key in ("q", "dq", "F"))
                self.show()
