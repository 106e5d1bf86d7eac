"""Scenarios made from the examples."""

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
