"""Bridge.fmu alone, driven by a moving force in FMPy, reproduces the closed solution (docs/theory.md 15, Frýba 1999).

R1's bridge is a simply supported beam with 49 supports at the spacing a = L/50. The force P at x = v t is shared by the
two supports beside it in proportion; on the first and last bay the abutments take their share. Damping is switched off.
"""

import numpy as np
import pytest
from fmpy import simulate_fmu

EI, MASS, L = 4.39668e11, 29720.0, 32.5
BAYS, STEPS_PER_BAY = 50, 20
P = 1e5
STATIC = P * L**3 / (48 * EI)


def passage(fmu, alpha):
    """Mid-span displacement while the force crosses, with α = π v / (L ω₁)."""
    first = (np.pi / L) ** 2 * np.sqrt(EI / MASS)
    crossing = np.pi / (alpha * first)
    steps = BAYS * STEPS_PER_BAY
    h = crossing / steps
    names = fmu.names("input")
    signals = np.zeros(steps + 1, dtype=[("time", float), *((name, float) for name in names)])
    signals["time"] = np.arange(steps + 1) * h
    bays = np.arange(steps + 1) / STEPS_PER_BAY
    for i, name in enumerate(names, 1):
        signals[name] = P * np.clip(1 - np.abs(bays - i), 0, None)
    values = {"damping_ratio": 0.0, "step_size": h}
    options = {"input": signals, "output": ["point[mid].displacement"], "output_interval": h, "stop_time": crossing}
    return simulate_fmu(str(fmu.folder), start_values=values, **options)["point[mid].displacement"]


@pytest.mark.parametrize("alpha, amplification", [(0.2, 1.06527), (0.3, 1.41049), (0.5, 1.70545), (0.617, 1.73167), (1.0, 1.54807)])
def test_a_moving_force_deflects_the_bridge_as_fryba_says(r1, alpha, amplification):
    """Dynamic amplification at mid-span against PL³/48EI, within 0.5 %."""
    assert len(r1.bridge.names("input")) == BAYS - 1
    assert passage(r1.bridge, alpha).max() / STATIC == pytest.approx(amplification, rel=0.005)
