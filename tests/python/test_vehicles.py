"""Vehicles of bodies, wheels and links against a model of NumPy that is written from the equations of motion."""

import json

import numpy as np
import pandas
import pytest

G = 9.81
SPEED, H, END = 50.0, 1e-3, 1.2
WAVES = [(1e-3, 8.0), (3e-4, 3.0)]
START, GROWS = 5.0, 10.0
HERTZ = 4e-8
FRONT = 0.0


def articulated():
    """Two coaches over three bogies, the middle one shared; the second coach's centre of gravity is off its middle."""
    bodies = [("a", 28000, 9e5, 11.75), ("b", 26000, 8e5, 29.5)]
    bodies += [(name, 3000, 2500, x) for name, x in (("p", 3.0), ("q", 21.0), ("r", 39.0))]
    links = [("a", "p", 3.0, 6e5, 3e4), ("a", "q", 20.5, 6e5, 3e4), ("b", "q", 21.5, 6e5, 3e4), ("b", "r", 39.0, 6e5, 3e4)]
    wheels = []
    for name, x in (("p", 3.0), ("q", 21.0), ("r", 39.0)):
        for arm in (-1.5, 1.5):
            wheels.append((x + arm, 1600))
            links.append((name, f"wheel{len(wheels)}", x + arm, 2e6, 1e4))
    return bodies, wheels, links


def scenario(bodies, wheels, links):
    """Over a rail and a bridge that hardly move."""
    vehicle = {
        "bodies": [dict(zip(("name", "mass", "inertia", "x"), body)) for body in bodies],
        "wheels": [dict(zip(("x", "mass"), wheel)) for wheel in wheels],
        "links": [{"between": [a, b], "x": x, "stiffness": k, "damping": c} for a, b, x, k, c in links],
        "length": 42,
    }
    support = {"type": "single-layer", "fastener": {"stiffness": 1e13, "damping": 1e6}}
    waves = [{"amplitude": a, "wavelength": length} for a, length in WAVES]
    span = {"length": 10, "bending_stiffness": 1e16, "mass": 1e5}
    return {
        "train": {"cars": [vehicle], "speed": {"m_s": SPEED}, "front_wheel": FRONT, "pre_roll": 0},
        "contact": {"law": "linear", "wheels_per_axle": 1, "hertz_constant": HERTZ},
        "track": {"type": {"rail": {"bending_stiffness": 1e11, "mass": 120}, "support": support, "spacing": 0.6}},
        "irregularity": {"type": "harmonics", "waves": waves, "origin": 0, "ramp": {"start": START, "length": GROWS}},
        "bridge": {"at": 45, "structure": {"type": "beams", "spans": [span]}, "damping": {"type": "none"}},
        "time": {"step": H, "end": END},
        "output": {"peaks_from": "start"},
    }


def rail(x):
    """r(x), m."""
    s = np.clip((x - START) / GROWS, 0, 1)
    return s**3 * (10 - 15 * s + 6 * s**2) * sum(a * np.sin(2 * np.pi * x / length) for a, length in WAVES)


def model(bodies, wheels, links):
    """M, C, K, weights; degrees of freedom z, θ of each body, then z of each wheel."""
    n = 2 * len(bodies) + len(wheels)
    names = [body[0] for body in bodies]

    def motion(name, x):
        row = np.zeros(n)
        if name in names:
            at = names.index(name)
            row[2 * at], row[2 * at + 1] = 1, bodies[at][3] - x
        else:
            row[2 * len(bodies) + int(name[5:]) - 1] = 1
        return row

    mass = np.diag([value for body in bodies for value in body[1:3]] + [wheel[1] for wheel in wheels])
    stiffness, damping = np.zeros((n, n)), np.zeros((n, n))
    for a, b, x, k, c in links:
        row = motion(a, x) - motion(b, x)
        stiffness += k * np.outer(row, row)
        damping += c * np.outer(row, row)
    weight = G * np.array([value for body in bodies for value in (body[1], 0)] + [wheel[1] for wheel in wheels])
    return mass, damping, stiffness, weight


def static_loads(stiffness, weight, held):
    """All wheels held: what the holders carry."""
    q = np.linalg.solve(stiffness[:held, :held], weight[:held])
    return weight[held:] - stiffness[held:, :held] @ q


@pytest.fixture(scope="module")
def found(ttb, tmp_path_factory):
    """Results of the program."""
    folder = tmp_path_factory.mktemp("articulated")
    (folder / "s.json").write_text(json.dumps(scenario(*articulated())))
    ttb("run", folder / "s.json", "-q", "-o", folder)
    return pandas.read_csv(folder / "results.csv")


def test_static_wheel_loads_follow_from_equilibrium(found):
    """At the start; they add up to the weight, and the shared bogie carries most."""
    bodies, wheels, links = articulated()
    mass, _, stiffness, weight = model(bodies, wheels, links)
    loads = static_loads(stiffness, weight, 2 * len(bodies))
    first = [found[f"wheel[{i + 1}].contact_force"][0] for i in range(len(wheels))]
    assert first == pytest.approx(loads, rel=1e-6)
    assert sum(first) == pytest.approx(weight.sum(), rel=1e-9)
    assert min(first[2:4]) > max(first[0], first[5])


def test_an_articulated_set_moves_as_numpy_says(found):
    """Newmark's trapezoidal rule with the same step, contacts linear: coaches, the shared bogie, contact forces."""
    bodies, wheels, links = articulated()
    mass, damping, stiffness, weight = model(bodies, wheels, links)
    held = 2 * len(bodies)
    loads = static_loads(stiffness, weight, held)
    contact = 1.5 * np.cbrt(loads) / HERTZ
    b = np.zeros((len(wheels), len(weight)))
    b[:, held:] = np.eye(len(wheels))
    k = stiffness + b.T @ np.diag(contact) @ b
    places = FRONT - (np.array([wheel[0] for wheel in wheels]) - wheels[0][0])
    u, v, a = (np.zeros(len(weight)) for _ in range(3))
    effective = k + 2 / H * damping + 4 / H**2 * mass
    rows = []
    for step in range(1, round(END / H) + 1):
        r = rail(places + SPEED * step * H)
        p = b.T @ (contact * r) + mass @ (4 / H**2 * u + 4 / H * v + a) + damping @ (2 / H * u + v)
        new = np.linalg.solve(effective, p)
        accelerated = 4 / H**2 * (new - u) - 4 / H * v - a
        u, v, a = new, v + H / 2 * (a + accelerated), accelerated
        rows.append(np.concatenate([a, loads + contact * (b @ u - r)]))
    expected = np.array(rows)
    n = len(weight)
    columns = {"car[1].acceleration": 0, "car[1].pitch_acceleration": 1, "car[1].b.acceleration": 2}
    columns |= {"car[1].b.pitch_acceleration": 3, "car[1].q.acceleration": 6}
    columns |= {f"wheel[{i + 1}].contact_force": n + i for i in range(len(wheels))}
    for name, column in columns.items():
        series = found[name].to_numpy()[1:]
        assert np.abs(series - expected[:, column]).max() < 2e-3 * np.abs(expected[:, column]).max(), name


def test_forces_by_name_pass_over_a_bridge(ttb, tmp_path):
    """HSLM-A3 without a mass under it: every axle presses with 180 kN at all times."""
    span = {"length": 25, "first_frequency": 4, "mass": 15000}
    bridge = {"structure": {"type": "beams", "spans": [span]}, "damping": {"type": "rayleigh", "ratio": 0.01}}
    train = {"forces": "hslm-a3", "speed": {"km_h": 250}}
    (tmp_path / "s.json").write_text(json.dumps({"train": train, "bridge": bridge, "time": {"end": 1.0}}))
    ttb("run", tmp_path / "s.json", "-q", "-o", tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text())
    force = summary["peaks"]["wheel[1].contact_force"]
    assert force["min"]["value"] == force["max"]["value"] == 180e3
    assert summary["peaks"]["point[mid].displacement"]["max"]["value"] > 1e-3
    resolved = json.loads((tmp_path / "scenario.resolved.json").read_text())
    assert len(resolved["train"]["forces"]) == 46
