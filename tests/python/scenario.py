"""Scenarios made from the examples, and one of a derailment."""

import json


def changed(example, target, changes):
    """Writes a copy of a scenario with values set at dotted paths, e.g. {"time.step": 5e-5}; returns its path."""
    scenario = json.loads(example.read_text())
    for path, value in changes.items():
        *way, last = path.split(".")
        place = scenario
        for key in way:
            place = place.setdefault(key, {})
        place[last] = value
    target.write_text(json.dumps(scenario))
    return target


# Rails that turn aside by 30 mm within some metres: a car at 60 m/s derails.
KICK = {
    "title": "a kick",
    "train": {"cars": ["manchester"], "front_wheel": 25, "speed": {"m_s": 60}, "pre_roll": 0},
    "space": {
        "irregularity": {
            "type": "harmonics",
            "alignment": [{"amplitude": 0.03, "wavelength": 10}],
            "origin": 30,
            "ramp": {"start": 30, "length": 5},
        }
    },
    "track": {"type": "slab", "from": -15, "bays": 160},
    "bridge": {
        "at": 60,
        "structure": {"type": "beams", "spans": [{"length": 13, "bending_stiffness": 1e11, "mass": 1e4}]},
        "damping": {"type": "rayleigh", "ratio": 0.02, "at": {"first_times": 4}},
    },
    "time": {"step": 1e-3, "end": 1.0},
}
