"""TrainTrack.fmu alone in FMPy, on a rigid bridge: all defaults, other time grids, other parameters."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmu import FMU2Instance

# docs/theory.md 15: P0 of the ICE 3 trailer, and of the motor car that leads the bundled train, N.
TRAILER, MOTOR = 143_226.0, 156_960.0


def simulate(fmu, **options):
    """FMPy's one verb, on the folder that is unzipped already."""
    return simulate_fmu(str(fmu.folder), **options)


@pytest.mark.parametrize("scenario, load", [("r1", TRAILER), ("default", MOTOR)])
def test_a_train_on_a_rigid_bridge_keeps_its_weight_on_its_wheels(request, scenario, load):
    """All defaults, zero inputs: over the run the mean contact force is the axle load, and no wheel lifts off."""
    fmu = request.getfixturevalue(scenario).train_track
    result = simulate(fmu)
    assert result["time"][-1] == float(fmu.description.defaultExperiment.stopTime)
    assert all(np.isfinite(result[name]).all() for name in result.dtype.names)
    for wheel in range(1, 5):
        force = result[f"wheel[{wheel}].contact_force"]
        assert force.mean() == pytest.approx(load, rel=0.01)
        assert 0.5 * load < force.min() < load < force.max() < 1.5 * load


def test_a_smooth_rigid_track_carries_exactly_the_weight(r1):
    """Without irregularity and deck motion the car's weight is all there is: forces sum up to it at the start."""
    with FMU2Instance(r1.train_track) as train_track:
        train_track.initialize(irregularity_scale=0.0)
        forces = train_track.get(*[f"wheel[{i}].contact_force" for i in range(1, 5)])
        assert forces.sum() == pytest.approx(4 * TRAILER, rel=1e-9)


def wheel_force(fmu, interval, **parameters):
    """Contact force of the leading axle in communication steps of `interval`."""
    options = {"output": ["wheel[1].contact_force"], "stop_time": 0.7, "start_values": parameters}
    return simulate(fmu, output_interval=interval, **options)["wheel[1].contact_force"]


@pytest.mark.parametrize("multiple", [2, 5])
def test_a_longer_communication_step_is_divided_into_nominal_ones(r1, multiple):
    """With inputs that do not change the division cannot be seen."""
    nominal = wheel_force(r1.train_track, 1e-3)
    assert wheel_force(r1.train_track, multiple * 1e-3) == pytest.approx(nominal[::multiple], rel=1e-9)


@pytest.mark.parametrize("interval", [5e-4, 7e-4])
def test_a_shorter_communication_step_is_taken_as_it_is(r1, interval):
    """Factorised anew: the force comes nearer to that of a much finer step (root mean square)."""
    fine = wheel_force(r1.train_track, 1e-4, step_size=1e-4)

    def error(step):
        force = wheel_force(r1.train_track, step)
        times = np.arange(len(force)) * step
        return np.sqrt(np.mean((force - np.interp(times, np.arange(len(fine)) * 1e-4, fine)) ** 2))

    assert error(interval) < 0.6 * error(1e-3) < 0.005 * TRAILER


def test_speed_front_wheel_and_irregularity_scale_take_effect(r1):
    """Parameters as start values: the wheels are where they should be; without irregularity the force hardly varies."""
    names = ["wheel[1].position", "wheel[1].contact_force"]
    values = {"speed": 50.0, "front_wheel": 31.0, "irregularity_scale": 0.0}
    result = simulate(r1.train_track, start_values=values, output=names)
    assert result[names[0]] == pytest.approx(31 + 50 * result["time"], rel=1e-12)
    assert np.ptp(result[names[1]]) < 0.05 * TRAILER < np.ptp(simulate(r1.train_track, output=names)[names[1]])


def test_another_seed_gives_another_irregularity_and_the_same_seed_the_same(default):
    """irregularity_seed of the bundled scenario's spectrum."""

    def forces(seed):
        options = {"start_values": {"irregularity_seed": seed}, "stop_time": 0.3, "output": ["wheel[1].contact_force"]}
        return simulate(default.train_track, **options)["wheel[1].contact_force"]

    assert (forces(1) == forces(1)).all()
    assert np.abs(forces(2) - forces(1)).max() > 100.0


def test_fastener_factors_take_effect(r1):
    """Softer fasteners: the rail under the standing wheel goes down further; damping does not matter at rest."""

    def settlement(**parameters):
        with FMU2Instance(r1.train_track) as train_track:
            return train_track.initialize(irregularity_scale=0.0, **parameters).get("wheel[1].rail_displacement")

    assert settlement(fastener_stiffness_factor=0.5) > 1.4 * settlement()
    assert settlement(fastener_damping_factor=0.5) == settlement()
    forces = [
        simulate(r1.train_track, start_values={"fastener_damping_factor": factor}, output=["wheel[1].contact_force"])
        for factor in (0.5, 1.0)
    ]
    assert np.abs(forces[0]["wheel[1].contact_force"] - forces[1]["wheel[1].contact_force"]).max() > 100.0
