"""Moving forces over continuous beams, by another program: finite elements of Euler-Bernoulli beams in dense matrices,
modal damping, Newmark's method (average acceleration) in all degrees of freedom with a step of 0.1 ms. It shares nothing
with the project. Run it with numpy and scipy to get the numbers of `independent.rs`.
"""

import numpy as np
from scipy.linalg import cho_factor, cho_solve, eigh


def beam(spans, ei, mass, per_span=20):
    n = per_span * len(spans)
    lengths = np.repeat([s / per_span for s in spans], per_span)
    x = np.concatenate([[0.0], np.cumsum(lengths)])
    k, m = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    for e, l in enumerate(lengths):
        d = slice(2 * e, 2 * e + 4)
        k[d, d] += ei / l**3 * np.array(
            [[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l],
             [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
        m[d, d] += mass * l / 420 * np.array(
            [[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l],
             [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
    bearings = [0] + list(np.cumsum([per_span] * len(spans)))
    free = [d for d in range(2 * n + 2) if d not in [2 * b for b in bearings]]
    return x, free, k[np.ix_(free, free)], m[np.ix_(free, free)]


def shape(x, free, at):
    row = np.zeros(2 * len(x))
    if x[0] <= at <= x[-1]:
        e = min(np.searchsorted(x, at, side="right") - 1, len(x) - 2)
        l = x[e + 1] - x[e]
        s = (at - x[e]) / l
        row[2 * e:2 * e + 4] = [1 - 3 * s**2 + 2 * s**3, l * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, l * (s**3 - s**2)]
    return row[free]


def run(spans, ei, mass, zeta, axles, speed, points, kept, h=1e-4, free_time=1.0):
    x, free, k, m = beam(spans, ei, mass)
    w2, phi = eigh(k, m)
    phi = phi[:, :kept]  # the modes that the project keeps: all others would ring undamped or not in the limits
    omega = np.sqrt(w2[:kept])
    table_x = np.linspace(x[0], x[-1], 4001)
    table = np.array([shape(x, free, a) @ phi for a in table_x])
    rows = np.array([shape(x, free, p) @ phi for p in points])
    length = axles[-1][0]
    steps = int(np.ceil(((x[-1] + length) / speed + free_time) / h))
    force = np.zeros((steps + 1, kept))
    t = np.arange(steps + 1) * h
    for xa, p in axles:
        s = speed * t - xa
        on = (s >= 0) & (s <= x[-1])
        for j in range(kept):
            force[on, j] += p * np.interp(s[on], table_x, table[:, j])
    c, kk = 2 * zeta * omega, omega**2
    q, v = np.zeros(kept), np.zeros(kept)
    a = force[0].copy()
    den = 1 + 0.5 * h * c + 0.25 * h * h * kk
    largest = np.zeros((2, len(points)))
    for n in range(1, steps + 1):
        qp, vp = q + h * v + 0.25 * h * h * a, v + 0.5 * h * a
        a = (force[n] - c * vp - kk * qp) / den
        q, v = qp + 0.25 * h * h * a, vp + 0.5 * h * a
        largest[0] = np.maximum(largest[0], np.abs(rows @ q))
        largest[1] = np.maximum(largest[1], np.abs(rows @ a))
    return omega / (2 * np.pi), largest


def units(*list_of):
    axles, at = [], 0.0
    for gaps, load, count in list_of:
        for _ in range(count):
            for g in gaps[:-1]:
                at += g
                axles.append((at, 1e3 * load))
            at += gaps[-1]
    return [(a - axles[0][0], p) for a, p in axles]


ANNEX_D5 = units(([2, 2.1, 2.1, 4.4, 2.1, 2.1, 2], 225, 1), ([2, 1.8, 1.8, 5.7, 1.8, 1.8, 2], 225, 15))
D4 = units(([1.5, 1.8, 4.65, 1.8, 1.5], 22.5 * 9.81, 10))
USER = [(0.0, 180e3), (2.7, 180e3), (9.1, 150e3), (11.8, 160e3), (20.0, 90e3)]
ICE2 = [(a, 195e3) for a in (0, 3, 11.46, 14.46)]
ICE2 += [(19.31 + 26.4 * i + o, 112e3) for i in range(12) for o in (0, 2.5, 19, 21.5)]
ICE2 += [(a, 195e3) for a in (336.06, 339.06, 347.52, 350.52)]

if __name__ == "__main__":
    cases = [
        ("two equal spans", [24.0, 24.0], 50e9, 16e3, 0.01, "ice2", ICE2, 290.0, [12.0, 36.0], 8),
        ("three spans", [20.0, 28.0, 20.0], 60e9, 14e3, 0.01, "en15528-d4x10", D4, 110.0, [10.0, 34.0], 8),
        ("one span", [12.0], 5e9, 10e3, 0.02, "annex-d-5", ANNEX_D5, 80.0, [6.0], 3),
        ("one span, user", [30.0], 70e9, 18e3, 0.005, "user", USER, 180.0, [7.5, 15.0], 3),
    ]
    for what, spans, ei, mass, zeta, name, axles, speed, points, kept in cases:
        f, largest = run(spans, ei, mass, zeta, axles, speed / 3.6, points, kept)
        print(what, name, speed, "f:", np.round(f, 4))
        for i, p in enumerate(points):
            print(f"   {p}: {1e3 * largest[0, i]:.4f} mm, {largest[1, i]:.4f} m/s2")
