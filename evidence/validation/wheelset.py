"""Modes of a wheelset, and what an axlebox vibrates with in service.

Vehicles and tolerances were chosen before the first run: the shipped vehicles on the better line of ERRI B176
from 200 km/h on, else on the worse one, all with the rail roughness of ISO 3095. The worn line, with a
corrugation of its own, was chosen after the levels on smooth rails had been seen, the Chinese line before its
run, its roughness, that of French high-speed lines, after it. Levels are those of a sensor 170 mm above the
bearing's centre, 10 to 500 Hz, as the rail model moves box and journal.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks

from beardyn_core.config import load_vehicle
from beardyn_core.rail.build import RIDE_RATE, ride_steps
from beardyn_core.rail.vehicle import WHEEL, quarter_vehicle
from beardyn_core.rail.wheelset import bending, half_shaft, torsion
from beardyn_core.scene.excitation import Corrugation, Irregularity
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from evidence.validation.anchor import HOLDS_FROM, Anchor, Finding, Trend

Float = NDArray[np.float64]

POPP = "Popp, Kruse, Kaiser 1999, Veh. Syst. Dyn. 31, free wheelset of a high-speed car, from memory"
POLYGONS = (
    "Shock Vib. 2018, 6759105: measured on bogies of Chinese high-speed trains, 565 to 616 Hz, where wheels "
    "grow 22 to 24 waves"
)
IEC = (
    "IEC 61373:2010, category 3 (axle): functional test of 38.0 m/s2 rms vertically, as in imvlab.com, table "
    "06_01; the shape of its density is from memory and has that level"
)
GEARS = (
    "Li, Wang, Xu, Li 2017, World J. Eng. Technol. 5, 254, abstract: a gear case on an axle of the Wuhan to "
    "Guangzhou line, 62 % less vertically at 200 than at 300 km/h"
)
LINES = (
    "Vibration characteristics and PSD of axle boxes of high-speed trains, Noise Vib. Control 2024 (6): five "
    "Chinese lines, from the abstract"
)
P2 = (
    "Adv. Mech. Eng. 2025, 10.1177/16878132251320693, abstract: axleboxes above 350 km/h were measured to "
    "shake mainly around 40 Hz, where the eccentricity of wheels meets the P2 resonance"
)
SQUATS = (
    "Molodova, Li, Nunez, Dollevoet 2013, IEEE ITSC, 1316, abstract: measured power of axlebox acceleration "
    "over squats of Dutch track; 1060 to 1160 Hz, too, where our rail on spread seats has no mode"
)
SQUATS_HZ = 300.0
CHINA = (
    "Veh. Syst. Dyn. 2019, 58(10), 10.1080/00423114.2019.1645340: rms on the axlebox of a Chinese train at "
    "300 km/h, as quoted in github.com/bersamin12/nebulax (rail_phm.md); the band is not stated"
)
# Of a level whose band is not told.
CHINA_TOLERANCE: float = 0.3
CHINA_MISSES = (
    "the roughness of the line, which the source does not tell: with that of French high-speed lines ours is "
    "6.1 m/s2, at the limit of ISO 3095 it is 11.5"
)
SENSOR_HEIGHT = 0.17
SECONDS, SETTLED = 4.0, 0.5
FREIGHT = replace(Mounting(), journal_mass=675.0, box_mass=80.0)
OTHER_AXLE = (
    "that wheelset's dimensions are not known; with the axle of 173 mm of passenger_coach it is the row below"
)


@dataclass(frozen=True)
class Run:
    """A vehicle at a speed on a line."""

    operation: QuarterVehicleOperation
    mounting: Mounting

    @property
    def worn(self) -> Run:
        """The same on a bad line with corrugated rails."""
        line = Irregularity("sncf_bad", short_waves="average_network")
        waves = (Corrugation(0.07, 20e-6),)
        return replace(self, operation=replace(self.operation, irregularity=line, rail_defects=waves))


def run_at(vehicle: str, line: str, speed_kmh: float) -> Run:
    """Build the run of a shipped vehicle."""
    operation = QuarterVehicleOperation(
        load_vehicle(vehicle),
        Irregularity(line, short_waves="iso_3095"),
        ((0.0, speed_kmh / 3.6),),
        lateral=True,
        wheelset="elastic",
    )
    if vehicle == "freight_y25":
        return Run(replace(operation, payload=70e3), FREIGHT)
    return Run(operation, Mounting())


RUNS = {
    80: run_at("freight_y25", "german_high", 80.0),
    120: run_at("passenger_coach", "german_high", 120.0),
    200: run_at("emu_300", "german_low", 200.0),
    300: run_at("emu_300", "german_low", 300.0),
}


@lru_cache(maxsize=16)
def spectra(
    speed_kmh: int, worn: bool = False, wheelset: str = "elastic", line: str = "", roughness: str = "iso_3095"
) -> tuple[Float, Float, Float]:
    """Compute the mean squares of a run's acceleration by frequency [Hz], up and to the side, [m^2/s^4].

    On its own line, the same worn, or another `line` with a level of rail roughness.
    """
    run = RUNS[speed_kmh].worn if worn else RUNS[speed_kmh]
    operation = replace(run.operation, wheelset=wheelset)
    if line:
        operation = replace(
            operation, irregularity=replace(operation.irregularity, kind=line, short_waves=roughness)
        )
    steps = int((SECONDS + SETTLED) * RIDE_RATE)
    ride, besides = ride_steps(operation, run.mounting, steps, 5)
    assert besides is not None
    assert besides.sway is not None
    up, aside, tilt = ride.box, besides.sway.motion[:, 0], ride.tilt
    if besides.sway.flexing is not None:
        up, tilt = up + besides.sway.flexing.rise, tilt + besides.sway.flexing.tilt

    def squares(place: Float) -> Float:
        motion = np.diff(place, 2)[int(SETTLED * RIDE_RATE) :] * RIDE_RATE**2
        lines = np.fft.rfft(motion - motion.mean())
        return np.asarray(2.0 * np.abs(lines) ** 2 / len(motion) ** 2)

    upwards = squares(up)
    frequency = np.arange(len(upwards)) / SECONDS
    return frequency, upwards, squares(aside - SENSOR_HEIGHT * tilt)


def level(
    speed_kmh: int, sideways: bool, worn: bool = False, band: tuple[float, float] = (10.0, 500.0)
) -> float:
    """Return the level of a run in a band [Hz], [m/s^2]."""
    frequency, up, aside = spectra(speed_kmh, worn)
    within = (frequency >= band[0]) & (frequency < band[1])
    return float(np.sqrt((aside if sideways else up)[within].sum()))


def first_bending(speed_kmh: int, symmetric: bool) -> float:
    """Return the first bending frequency of the free wheelset of a run, [Hz]."""
    half = half_shaft(RUNS[speed_kmh].operation, Mounting(), 0.0)
    assert half is not None
    return float(bending(half, Mounting().journal_mass, symmetric).frequency[0])


def first_torsion() -> float:
    """Return the first torsion frequency of the free wheelset of emu_300, [Hz]."""
    half = half_shaft(RUNS[300].operation, Mounting(), 0.0)
    assert half is not None
    return float(torsion(half).frequency[0])


def wave_peaks(speed_kmh: int, low: float, high: float) -> list[tuple[float, float]]:
    """List the peaks of the wheel-rail force over waves of wheel or rail of a run, [Hz] and [N/m].

    Between two frequencies [Hz], where they are highest first.
    """
    vehicle = quarter_vehicle(RUNS[speed_kmh].operation, Mounting())
    assert vehicle.bending is not None
    pushed = np.zeros(len(vehicle.mass))
    pushed[WHEEL], pushed[4:] = 1.0, vehicle.bending.wheel
    pressed = 1.5 * vehicle.static_force ** (1.0 / 3.0) / vehicle.contact_flexibility
    frequencies = np.arange(low, high)
    force = []
    for frequency in frequencies:
        omega = 2.0 * np.pi * frequency
        dynamic = vehicle.stiffness + 1j * omega * vehicle.damping - omega**2 * np.diag(vehicle.mass)
        gives = 1.0 / pressed + vehicle.rail.receptance(frequency) + pushed @ np.linalg.solve(dynamic, pushed)
        force.append(float(abs(1.0 / gives)))
    peaks, _ = find_peaks(force)
    return sorted(((float(frequencies[at]), force[at]) for at in peaks), key=lambda peak: -peak[1])


def hardest_wave() -> float:
    """Return where waves of the wheel meet a resonance of emu_300 above 400 Hz: peak of the force, [Hz]."""
    return wave_peaks(300, 400.0, 900.0)[0][0]


def lowest_wave() -> float:
    """Return where the wheelset of emu_300 bounces on its track: peak of the force below 100 Hz, [Hz]."""
    found = wave_peaks(300, 15.0, 100.0)
    return found[0][0] if found else float("nan")


def wave_of_squats() -> float:
    """Return the peak of the force of passenger_coach that is next to 300 Hz, [Hz]."""
    found = [frequency for frequency, _ in wave_peaks(120, 150.0, 900.0)]
    return min(found, key=lambda frequency: abs(frequency - SQUATS_HZ)) if found else float("nan")


def standard_level(low: float, high: float) -> float:
    """Return the level of the functional test of IEC 61373 in a band [Hz], vertical, on the axle, [m/s^2].

    8.74 (m/s^2)^2/Hz from 20 to 100 Hz, 6 dB an octave less on both sides: 38 m/s^2 from 10 to 500 Hz.
    """
    frequency = np.linspace(low, high, 10_001)
    density = 8.74 * np.minimum(1.0, np.minimum((frequency / 20.0) ** 2, (100.0 / frequency) ** 2))
    return float(np.sqrt(np.trapezoid(density, frequency)))


def bands_against_the_standard() -> Finding:
    """Compare the level below 300 Hz and that from 500 to 1000 Hz with the standard's."""
    low, high = (level(300, False, band=band) for band in ((10.0, 300.0), (500.0, 1000.0)))
    frequency, up, _ = spectra(300, wheelset="rigid")
    rigid = float(np.sqrt(up[(frequency >= 500.0) & (frequency < 1000.0)].sum()))
    test = standard_level(10.0, 300.0), standard_level(500.0, 1000.0)
    return Finding(
        low < (1.0 - HOLDS_FROM) * test[0] and high > (1.0 + HOLDS_FROM) * test[1],
        f"emu_300 at 300 km/h: {low:.0f} m/s^2 up to 300 Hz, where the standard has {test[0]:.0f}, and "
        f"{high:.0f} from 500 to 1000 Hz, where it would have {test[1]:.0f} if it went on as it ends. With a "
        f"rigid wheelset the latter is {rigid:.0f}: it comes from boxes on the short ends of their axles.",
    )


def level_in_china(speed_kmh: int = 300) -> float:
    """Return the vertical level of emu_300 on a good Chinese line, 10 to 500 Hz, [m/s^2]."""
    frequency, up, _ = spectra(speed_kmh, line="china_ballastless", roughness="good")
    return float(np.sqrt(up[(frequency >= 10.0) & (frequency < 500.0)].sum()))


def growth_with_speed() -> float:
    """Return by which share emu_300 on a good Chinese line vibrates less at 200 than at 300 km/h."""
    return 1.0 - level_in_china(200) / level_in_china(300)


def levels_under_the_test() -> Finding:
    """Compare the levels of all runs with that of the functional test of the standard."""
    found = {speed: (level(speed, False), level(speed, False, worn=True)) for speed in RUNS}
    limit = standard_level(10.0, 500.0)
    words = ", ".join(
        f"{one:.0f} and {worn:.0f} m/s^2 at {speed} km/h" for speed, (one, worn) in found.items()
    )
    return Finding(
        all(one < limit for one, _ in found.values()),
        f"On a line at the limit of ISO 3095, and on a worn one with corrugation of 20 um: {words}, where "
        f"the test has {limit:.0f}.",
    )


MODES = (
    ("first bending of a free wheelset, wheels alike", 84.0, partial(first_bending, 300, True), ""),
    ("first bending, wheels against each other", 157.0, partial(first_bending, 300, False), OTHER_AXLE),
    ("the same of passenger_coach", 157.0, partial(first_bending, 120, False), ""),
    ("first torsion", 82.0, first_torsion, ""),
)
ANCHORS = (
    *(
        Anchor("wheelset", quantity, value, "Hz", POPP, ours, tolerance=0.15, misses=misses)
        for quantity, value, ours, misses in MODES
    ),
    Anchor(
        "wheelset",
        "peak of the wheel-rail force over waves of the wheel, above 400 Hz",
        590.5,
        "Hz",
        POLYGONS,
        hardest_wave,
        absolute=25.5,
        measured=True,
    ),
    # "around": a tenth of the figure and half as much again for the track, which neither source tells
    Anchor(
        "axlebox resonance",
        "bounce on the track, emu_300",
        40.0,
        "Hz",
        P2,
        lowest_wave,
        tolerance=0.15,
        measured=True,
    ),
    Anchor(
        "axlebox resonance",
        "peak over squats, passenger_coach",
        SQUATS_HZ,
        "Hz",
        SQUATS,
        wave_of_squats,
        tolerance=0.15,
        measured=True,
    ),
    Anchor(
        "axlebox vibration",
        "vertical at 300 km/h on a Chinese line, 10 to 500 Hz",
        8.8,
        "m/s2",
        CHINA,
        level_in_china,
        tolerance=CHINA_TOLERANCE,
        misses=CHINA_MISSES,
        measured=True,
    ),
    Anchor(
        "axlebox vibration",
        "vertical level at 200 km/h less than at 300 km/h by, on a Chinese line, 10 to 500 Hz",
        62.0,
        "%",
        GEARS,
        lambda: 100.0 * growth_with_speed(),
        absolute=10.0,
        measured=True,
    ),
)

TRENDS = (
    Trend(
        "axlebox vibration",
        "axleboxes at high speed shake less than the standard up to 300 Hz, more from 500 to 1000 Hz",
        LINES,
        bands_against_the_standard,
    ),
    Trend(
        "axlebox vibration",
        "axleboxes on lines in service vibrate less than in the functional test of the standard",
        IEC,
        levels_under_the_test,
    ),
)
