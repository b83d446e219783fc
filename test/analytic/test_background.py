"""What a sensor receives besides its bearing: published levels, orders of lines, impulses."""

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.config import load_background, load_bearing, shipped_names
from beardyn_core.rail.background import background_force
from beardyn_core.rail.build import load_history, load_of_scene
from beardyn_core.rail.patch import patch_gain
from beardyn_core.rail.roughness import roughness_height
from beardyn_core.scene.background import (
    Background,
    Drive,
    Knocks,
    OtherBearing,
    Pickup,
    PickupLine,
    Roughness,
)
from beardyn_core.scene.excitation import Irregularity
from beardyn_core.scene.operation import QuarterVehicleOperation

RATE = 20_000.0
TIME = np.arange(int(20 * RATE)) / RATE
SPEED = np.full(len(TIME), 60.0)
BEARING = load_bearing("HS130x230")
SCENE = load_scene("smooth_run")


def force_of(**parts: object) -> np.ndarray:
    return background_force(Background("test", "", **parts), BEARING, TIME, SPEED, 1)  # type: ignore[arg-type]


def amplitude(force: np.ndarray, order: float) -> float:
    window = np.hanning(len(TIME))
    return float(2.0 * abs(np.sum(window * force * np.exp(-1j * order * 60.0 * TIME))) / window.sum())


def test_gear_and_motor_stand_at_their_orders_with_their_forces() -> None:
    force = force_of(drive=Drive(40, 3.0, (80.0, 20.0), (1.0, 12.0), (30.0, 10.0)))
    for order, expected in ((40.0, 80.0), (80.0, 20.0), (3.0, 30.0), (36.0, 10.0)):
        assert amplitude(force, order) == pytest.approx(expected, rel=1e-3)
    assert force.var() == pytest.approx(0.5 * (80.0**2 + 20.0**2 + 30.0**2 + 10.0**2), rel=1e-3)


def test_lines_follow_the_shaft_and_leave_out_what_the_rate_cannot_carry() -> None:
    time, speed = TIME[:40_000], np.linspace(20.0, 100.0, 40_000)
    drive = Background("test", "", drive=Drive(40, 1.0, (100.0,)))
    force = background_force(drive, BEARING, time, speed, 1)
    crossings = np.count_nonzero(np.diff(np.signbit(force)))
    angle = 0.5 * (speed[1:] + speed[:-1]).sum() / RATE
    assert crossings == pytest.approx(2 * 40 * angle / (2.0 * np.pi), abs=2)
    # order 300 at 200 rad/s is 9.5 kHz, beyond 0.4 of the rate
    fast = Background("test", "", drive=Drive(300, 1.0, (100.0,)))
    assert not background_force(fast, BEARING, time, np.full(40_000, 200.0), 1).any()


def test_rollers_of_the_other_bearing_pass_a_little_slower() -> None:
    force = force_of(other_bearing=OtherBearing((20.0, 10.0), slip=0.002))
    passing = fault_frequencies(BEARING).bpfo * 0.998
    assert amplitude(force, passing) == pytest.approx(20.0, rel=1e-3)
    assert amplitude(force, 2.0 * passing) == pytest.approx(10.0, rel=1e-3)
    assert amplitude(force, passing / 0.998) < 0.5


@pytest.mark.parametrize("fault", ["cup", "cone", "roller"])
def test_a_fault_of_the_other_bearing_strikes_as_often_as_it_should(fault: str) -> None:
    """Impulses in the sum: all alike on the cup, 1/pi of the largest where it turns through the zone."""
    impulse, slip = 0.4, 0.001
    force = force_of(other_bearing=OtherBearing((0.0,), fault, impulse, slip=slip))
    rates, cage = fault_frequencies(BEARING), fault_frequencies(BEARING).ftf * (1.0 - slip)
    rollers, turns = BEARING.roller_count, 60.0 / (2.0 * np.pi)
    often = {"cup": rollers * cage, "cone": rollers * (1.0 - cage), "roller": 2.0 * rates.bsf * (1.0 - slip)}[
        fault
    ]
    mean = 1.0 if fault == "cup" else 1.0 / np.pi
    assert force.sum() / RATE / TIME[-1] == pytest.approx(often * turns * impulse * mean, rel=0.02)
    assert (force >= -1e-9).all()


def test_knocks_are_a_poisson_process_of_lognormal_impulses() -> None:
    force = force_of(knocks=Knocks(rate=8.0, impulse=0.2, spread=0.5, pulse=200e-6))
    edges = np.flatnonzero(np.diff((force != 0.0).astype(int)) == 1)
    count = 8.0 * TIME[-1]
    assert abs(len(edges) - count) < 4.0 * np.sqrt(count)
    sizes = np.array([abs(force[at : at + 7].sum()) / RATE for at in edges])
    assert np.median(sizes) == pytest.approx(0.2, rel=4.0 * 1.25 * 0.5 / np.sqrt(count))
    assert np.log(sizes).std() == pytest.approx(0.5, rel=0.3)


def test_a_longer_run_begins_with_the_same_background() -> None:
    background = load_background("driven_emu")
    scene = replace(SCENE, background=background)
    short, long = load_of_scene(scene, 0.5), load_of_scene(scene, 1.0)
    np.testing.assert_array_equal(short.wrench[:9_900], long.wrench[:9_900])


@pytest.mark.parametrize(
    ("rail", "wheel"), [("iso_3095", "none"), ("none", "disc_brake"), ("average_network", "cast_iron")]
)
def test_roughness_has_the_published_levels_behind_the_contact_patch(rail: str, wheel: str) -> None:
    """Third octaves within 1.5 dB: 512 m have many waves in each, a wheel of 2.9 m a few."""
    levels = {  # Directive (EU) 2015/996, table G-1: [dB re 1 um] at 200, 100, 50, 25, 12.5, 10 mm
        "iso_3095": (11.0, 4.9, -1.1, -5.6, -7.4, -8.0),
        "average_network": (6.5, 3.5, -0.2, -3.0, -8.0, -9.0),
        "disc_brake": (2.82, 2.06, -1.57, -7.0, -9.51, -10.12),
        "cast_iron": (2.17, 2.61, 11.11, 7.49, 1.29, 0.17),
        "none": (-np.inf,) * 6,
    }
    spacing = 0.001
    position = np.asarray(spacing * np.arange(500_000), dtype=np.float64)
    height = roughness_height(Roughness(rail, wheel), Irregularity("none"), 2.89, position, 3, 0.008)
    power = np.abs(np.fft.rfft(height)) ** 2 * 2.0 / len(height) ** 2
    cycles = np.fft.rfftfreq(len(height), spacing)
    for wavelength, of_rail, of_wheel in zip(
        (0.2, 0.1, 0.05, 0.025, 0.0125, 0.01), levels[rail], levels[wheel], strict=True
    ):
        middle = 1.0 / (0.4 * 10.0 ** (-0.1 * round(-10.0 * np.log10(wavelength / 0.4))))
        inside = (cycles >= middle * 10.0**-0.05) & (cycles < middle * 10.0**0.05)
        found = 10.0 * np.log10(power[inside].sum() / 1e-12)
        expected = 10.0 * np.log10(10.0 ** (0.1 * of_rail) + 10.0 ** (0.1 * of_wheel))
        expected += 20.0 * np.log10(float(patch_gain(np.array(2.0 * np.pi * middle), 0.008)))
        assert found == pytest.approx(expected, abs=1.5), wavelength


def test_roughness_reaches_the_journal_beyond_five_kilohertz() -> None:
    """At 200 km/h: some force at 5 to 8 kHz, and less than below; the load carries it without an image."""
    rough = Background("test", "", roughness=Roughness("average_network", "cast_iron"))
    load = load_of_scene(replace(SCENE, background=rough), 2.0)
    assert len(load) == 40_001
    force = load.wrench[8_000:, 2] - load.wrench[8_000:, 2].mean()
    power = np.abs(np.fft.rfft(force * np.hanning(len(force)))) ** 2 * 2.0 / len(force) / (0.375 * len(force))
    frequency = np.fft.rfftfreq(len(force), 1.0 / RATE)
    bands = [
        np.sqrt(power[(frequency >= low) & (frequency < high)].sum())
        for low, high in ((1e3, 2e3), (5e3, 8e3))
    ]
    assert 1.0 < bands[1] < 0.2 * bands[0]


def test_an_absent_background_and_one_without_forces_change_no_load() -> None:
    plain = load_of_scene(SCENE, 0.5)
    hum = Background("hum", "", pickup=Pickup(1e3, 1.0, (PickupLine(1, 2, 1e-3),)))
    for other in (
        load_history(SCENE.operation, SCENE.mounting, 0.5, SCENE.seed),
        load_of_scene(replace(SCENE, background=hum), 0.5),
    ):
        np.testing.assert_array_equal(plain.wrench, other.wrench)
        np.testing.assert_array_equal(plain.time_ns, other.time_ns)


@pytest.mark.parametrize("name", shipped_names("backgrounds"))
def test_every_part_of_a_shipped_background_names_its_source_or_says_that_it_is_assumed(name: str) -> None:
    background = load_background(name)
    told = {key.partition(".")[0] for key, _ in background.sources}
    parts = {
        part
        for part in ("roughness", "drive", "other_bearing", "knocks", "pickup")
        if getattr(background, part)
    }
    assert parts == told


def test_an_amplitude_factor_is_on_roughness_and_every_force_alike() -> None:
    scene = load_scene("service_high_speed")
    assert scene.background is not None
    loads = []
    for factor in (0.0, 1.0, 2.0):
        background = replace(scene.background, amplitude_factor=factor)
        loads.append(load_of_scene(replace(scene, background=background), 0.6).wrench[:, 2])
    silent, usual, loud = loads
    # forces are linear in it; the wheel on the rail is a spring that hardens
    assert np.std(loud - silent) == pytest.approx(2.0 * np.std(usual - silent), rel=0.02)
    assert isinstance(scene.operation, QuarterVehicleOperation)
    smooth = replace(scene.operation, irregularity=replace(scene.operation.irregularity, short_waves="none"))
    bare = replace(scene.background, roughness=None, drive=None, other_bearing=None, knocks=None)
    # at a lower rate, for it has no forces
    without = load_of_scene(replace(scene, operation=smooth, background=bare), 0.6)
    share = np.std(
        np.interp(1e-9 * without.time_ns, np.arange(len(silent)) / RATE, silent) - without.wrench[:, 2]
    )
    assert share < 0.05 * np.std(usual - silent)
