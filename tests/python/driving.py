"""Steps under inputs that keep an FMU busy."""

import numpy as np
from fmu import Reals

H = 1e-3


def drive(instance, first, steps, h=H):
    """Steps under inputs that change with time, every other one with derivatives; returns all outputs after each."""
    fmu = instance.fmu
    inputs, outputs = Reals(instance, fmu.names("input")), Reals(instance, fmu.names("output"))
    size = {"TrainTrack": 1e-4, "Bridge": 1e4}[fmu.identifier]
    rows = []
    for n in range(first, first + steps):
        inputs.set(size * np.sin(0.1 * n + np.arange(inputs.size)))
        if n % 2:
            inputs.set_rates(size / H * np.cos(0.3 * n + np.arange(inputs.size)))
        instance.doStep(n * H, h)
        rows.append(outputs.get())
    return np.array(rows)
