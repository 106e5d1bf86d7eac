"""Bridge.fmu alone in FMPy: at rest, under a standing load, ringing out."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmu import FMU2Instance

# docs/theory.md 15: bending stiffness, N m², length, m, first frequency, Hz, of R1's beam.
EI, L, F1 = 4.39668e11, 32.5, 5.7199


def test_a_bridge_without_forces_rests_exactly(r1, default):
    """All defaults: not a bit moves."""
    for pair in (r1, default):
        result = simulate_fmu(str(pair.bridge.folder))
        assert result["time"][-1] == float(pair.bridge.description.defaultExperiment.stopTime)
        assert all((result[name] == 0).all() for name in result.dtype.names if name != "time")


def test_the_bridges_stiffness_factor_halves_what_a_held_force_settles_to(r1):
    """Static deflection in initialization mode: PL³/48EI, and twice as stiff half as far."""

    def deflection(factor):
        with FMU2Instance(r1.bridge) as bridge:
            bridge.setupExperiment()
            bridge.enterInitializationMode()
            bridge.set({"stiffness_factor": factor, "support[25].force": 1e5})
            return bridge.get("point[mid].displacement")

    assert deflection(1.0) == pytest.approx(1e5 * L**3 / (48 * EI), rel=1e-6)
    assert deflection(2.0) == pytest.approx(deflection(1.0) / 2, rel=1e-12)


def test_the_bridges_damping_ratio_and_mass_factor_decide_how_it_rings(r1):
    """Free vibration after a load is let go: f₁ = F1 Hz (docs/theory.md 15), less with more mass; ζ from the decay."""

    def free(**parameters):
        with FMU2Instance(r1.bridge) as bridge:
            bridge.setupExperiment()
            bridge.set(parameters)
            bridge.enterInitializationMode()
            bridge.set({"support[25].force": 1e5})
            bridge.exitInitializationMode()
            bridge.set({"support[25].force": 0.0})
            motion = []
            for step in range(3000):
                bridge.doStep(step * 1e-3, 1e-3)
                motion.append(bridge.get("point[mid].displacement"))
        motion = np.array(motion)
        maxima = np.flatnonzero((motion[1:-1] > motion[:-2]) & (motion[1:-1] > motion[2:])) + 1
        periods = 6
        first, last = maxima[1], maxima[1 + periods]
        return periods / ((last - first) * 1e-3), np.log(motion[first] / motion[last]) / (2 * np.pi * periods)

    assert free(damping_ratio=0.01) == pytest.approx((F1, 0.01), rel=0.02)
    assert free(damping_ratio=0.05) == pytest.approx((F1 * np.sqrt(1 - 0.05**2), 0.05), rel=0.02)
    assert free(damping_ratio=0.01, mass_factor=4.0) == pytest.approx((F1 / 2, 0.01), rel=0.02)
