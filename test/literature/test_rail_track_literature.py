"""The lumped track and vehicle against published stiffness, resonances and loads."""

import dataclasses

import numpy as np
import pytest

from beardyn_core.rail.track import lump
from beardyn_core.rail.vehicle import GRAVITY, quarter_vehicle
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Track, Vehicle

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)


def test_rail_on_pads_has_the_point_stiffness_of_zhais_track():
    # 65 MN/m pads every 0.6 m under a 60 kg rail: 152 MN/m (beam on elastic foundation)
    stiff_bed = dataclasses.replace(Track(), ballast_stiffness=1e15, subgrade_stiffness=1e15)
    assert lump(stiff_bed).point_stiffness == pytest.approx(152e6, rel=0.01)


def test_point_stiffness_is_that_of_a_beam_on_elastic_foundation():
    track = Track()
    seat = 1 / (1 / track.pad_stiffness + 1 / track.ballast_stiffness + 1 / track.subgrade_stiffness)
    # Hetenyi: K = 2 sqrt(2) (E I)^(1/4) k^(3/4)
    expected = 2 * np.sqrt(2) * track.rail_bending_stiffness**0.25 * (seat / track.sleeper_spacing) ** 0.75
    assert lump(track).point_stiffness == pytest.approx(expected, rel=1e-12)


def test_wheel_on_track_resonates_at_the_p2_frequency_and_the_rail_on_the_contact_near_670_hz():
    operation = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 50.0),))
    vehicle = quarter_vehicle(operation, Mounting())
    wheel, rail = vehicle.mass[2], vehicle.mass[3]
    p2 = np.sqrt(lump(operation.track).point_stiffness / wheel) / (2 * np.pi)
    assert 40.0 < p2 < 60.0
    contact = 1.5 * vehicle.static_force ** (1 / 3) / vehicle.contact_flexibility
    resonance = np.sqrt(contact / rail) / (2 * np.pi)
    assert resonance == pytest.approx(670.0, rel=0.1)


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
