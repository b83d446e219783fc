"""The lumped track and vehicle against published stiffness, resonances and loads."""

import dataclasses

import numpy as np
import pytest

from beardyn_core.rail.track import rail_waves
from beardyn_core.rail.vehicle import BOX, GRAVITY, WHEEL, quarter_vehicle
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Track, Vehicle

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)


# a rail that does not shear
EULER = dataclasses.replace(Track(), rail_shear_stiffness=1e15)


def test_rail_on_pads_has_the_point_stiffness_of_zhais_track():
    # 65 MN/m pads every 0.6 m under a 60 kg rail: 152 MN/m (beam on elastic foundation)
    stiff_bed = dataclasses.replace(EULER, ballast_stiffness=1e15, subgrade_stiffness=1e15)
    assert rail_waves(stiff_bed).point_stiffness == pytest.approx(152e6, rel=0.01)


def test_point_stiffness_is_that_of_a_beam_on_elastic_foundation():
    seat = 1 / (1 / EULER.pad_stiffness + 1 / EULER.ballast_stiffness + 1 / EULER.subgrade_stiffness)
    # Hetenyi: K = 2 sqrt(2) (E I)^(1/4) k^(3/4)
    expected = 2 * np.sqrt(2) * EULER.rail_bending_stiffness**0.25 * (seat / EULER.sleeper_spacing) ** 0.75
    # the stretch closes upon itself after 18 m: 1e-6
    assert rail_waves(EULER).point_stiffness == pytest.approx(expected, rel=1e-4)


def timoshenko_receptance(track, frequency):
    """Displacement under a unit force on an endless Timoshenko beam on the seats of the track, [m/N].

    Fourier integral over the wavenumber in closed form, by the two decaying waves; with rotary inertia.
    Doyle (1997), Wave Propagation in Structures, chapter 5.
    """
    s = 2j * np.pi * np.asarray(frequency)
    below = track.subgrade_stiffness + s * track.subgrade_damping + s**2 * track.ballast_mass
    for stiffness, damping, mass in (
        (track.ballast_stiffness, track.ballast_damping, track.sleeper_mass),
        (track.pad_stiffness, track.pad_damping, track.rail_mass_per_length * track.sleeper_spacing),
    ):
        below = 1 / (1 / (stiffness + s * damping) + 1 / below) + s**2 * mass
    bed = below / track.sleeper_spacing
    bending, shear = track.rail_bending_stiffness, track.rail_shear_stiffness
    turning = shear + bending / 2.059e11 * 7850 * s**2
    # roots of bending shear k^4 + (bed bending + shear (turning - shear)) k^2 + bed turning, k^2 = -q^2
    half = 0.5 * (bed * bending + shear * (turning - shear)) / (bending * shear)
    root = np.sqrt(half**2 - bed * turning / (bending * shear) + 0j)
    q1, q2 = np.sqrt(half + root), np.sqrt(half - root)
    waves = (turning - bending * q1**2) / q1 - (turning - bending * q2**2) / q2
    return waves / (2 * (q2**2 - q1**2) * bending * shear)


def receptance(track, frequency):
    """The same of the model's waves."""
    rail = rail_waves(track)
    found = np.zeros(len(frequency), dtype=complex)
    for index, s in enumerate(2j * np.pi * frequency):
        for rates, inverse_mass in zip(rail.rates(), rail.inverse_mass, strict=True):
            found[index] += inverse_mass * np.linalg.inv(s * np.eye(6) - rates)[0, 3]
        found[index] += rail.residual_flexibility / (1 + s * rail.residual_time)
    return found


@pytest.mark.parametrize(
    ("track", "most"),
    [
        (Track(), 0.05),
        (dataclasses.replace(Track(), pad_damping=15e3, pad_stiffness=200e6), 0.08),
        (dataclasses.replace(Track(), rail_mass_per_length=49.4, rail_bending_stiffness=3.8e6), 0.05),
    ],
)
def test_receptance_is_that_of_an_endless_beam(track, most):
    frequency = np.array([0.1, 20.0, 50.0, 100.0, 200.0, 400.0, 700.0, 1000.0])
    exact = timoshenko_receptance(track, frequency)
    error = np.abs(receptance(track, frequency) / exact - 1)
    assert error.max() < most


def test_wheel_on_track_resonates_at_the_p2_frequency():
    operation = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 50.0),))
    vehicle = quarter_vehicle(operation, Mounting())
    p2 = np.sqrt(vehicle.rail.point_stiffness / vehicle.mass[[WHEEL, BOX]].sum()) / (2 * np.pi)
    assert 40.0 < p2 < 60.0


def test_hertz_contact_stiffness_at_85_kn():
    # 1.55 GN/m at 85 kN with the fit for worn profiles; the cone is softer
    operation = QuarterVehicleOperation(
        dataclasses.replace(VEHICLE, wheel_profile="cone"), Irregularity("none"), ((0.0, 50.0),)
    )
    flexibility = quarter_vehicle(operation, Mounting()).contact_flexibility
    worn = quarter_vehicle(dataclasses.replace(operation, vehicle=VEHICLE), Mounting()).contact_flexibility
    assert flexibility > 1.1 * worn
    assert 1.5 * 85e3 ** (1 / 3) / worn == pytest.approx(1.55e9, rel=0.01)


def test_static_load_of_an_ice3_like_axlebox():
    # 15.5 t axle load less the 1.8 t wheelset and with the 100 kg axlebox: about 68 kN
    operation = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 50.0),))
    vehicle = quarter_vehicle(operation, Mounting())
    expected = (47.8e3 / 8 + 3.5e3 / 4 + 100.0) * GRAVITY
    assert vehicle.static_force - vehicle.journal_weight == pytest.approx(expected, rel=1e-12)
    assert expected == pytest.approx(68.2e3, rel=0.001)
