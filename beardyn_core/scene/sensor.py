"""Sensors on the axlebox: what kind there is, where it sits, what is between the box and it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import At, Vector
from beardyn_core.bearing.roller_bearing import RollerBearing

RATES = (25_600.0, 51_200.0)  # the usual one, and the one that needs a fine step [Hz]
# of a run of which nothing higher is asked for, the force waveform included [Hz]
SLOW_RATES = (3_200.0, 6_400.0, 12_800.0)
ALL_RATES = (*SLOW_RATES, *RATES)
FINE_STEPS = 8  # fewest time steps per sample of 25.6 kHz that resolve the band of the faster rate
PASSBAND = 0.4  # of its rate a sensor measures all alike: what the anti-alias filter leaves as it is
AXES = ("x", "y", "z")
FARTHEST = 1.0  # that an axlebox reaches from the bearing [m]

RATE_WORDS = (
    f"51.2 needs an even numerics.steps_per_sample of {FINE_STEPS} or more, its default then; below 25.6 the "
    "same for all sensors, and the force waveform has it too. Left out where something is auto and "
    "vibration_to_Hz is given: the slowest that holds its third octave"
)

_Noise = A[float, At("m_per_s2_per_sqrt_Hz", ge=0.0), "white noise of each axis, one-sided"]
_Range = A[float, At("m_per_s2", gt=0.0), "clipping level of each axis"]
_Sensitivity = A[float, At("mV_per_m_per_s2", gt=0.0), "of the signal that electrical pickup adds to"]
_Resonance = A[
    float | None,
    At("Hz", gt=0.0, ge=500.0, le=100_000.0),
    "of the accelerometer on its mounting (ISO 5348); rigid when left out",
]
_Damping = A[float, At(gt=0.0, ge=0.001, le=0.9, absent=True), "of critical; 0.02 when left out"]
_LowPass = A[
    float | None,
    At("Hz", ge=10_000.0, le=200_000.0),
    "3 dB corner of the amplifier's low pass of second order; none when left out. Anti-aliasing to the rate, "
    "flat to 0.4 of it and 70 dB down from 0.6, is always there",
]


@dataclass(frozen=True)
class SensorType:
    """A kind of accelerometer, as its maker's data sheet has it; three axes alike."""

    name: A[str, At(longest=80), "of the kind"]
    description: A[str, At(usual=""), "what it is, in a few words"]
    noise_density: _Noise
    range: _Range
    sensitivity: _Sensitivity
    mounting_resonance: _Resonance = None
    mounting_damping_ratio: _Damping = 0.02
    low_pass: _LowPass = None
    sources: tuple[tuple[str, str], ...] = ()

    def __repr__(self) -> str:
        """Give the name with range and noise, in one line."""
        noise = f"{self.noise_density:g} m/s2 per root Hz"
        return f"SensorType {self.name}: to {self.range:g} m/s2, noise {noise}"

    def rules(self) -> Iterator[str]:
        """Check that a damping has a resonance to act on."""
        yield from _damping_of_nothing(self)


@dataclass(frozen=True)
class MeasuredPath:
    """A measured transfer path from the rigid box to a sensor, in place of a model of its structure.

    Notes
    -----
    The ratio of the acceleration at the sensor to that of the rigid box at its place, over the frequency. It
    is a filter behind the model: rollers and raceways do not feel it, so it is the cheaper and less true
    kind of a structure.
    """

    path: A[
        Path,
        "relative to the scene file; CSV with frequency_Hz and real, imaginary or magnitude_dB, phase_deg, "
        "or a Universal file (.uff, .unv) with one frequency response (data set 58)",
    ]
    axes: A[tuple[str, ...], At(one_of=AXES, size=(1, 3)), "of the sensor that it acts on"] = AXES
    content: A[
        str, At(absent=True), "the path itself, packed, as a recording has it; goes before the file"
    ] = ""


@dataclass(frozen=True)
class Accelerometer:
    """A three-axis accelerometer screwed to the axlebox.

    Notes
    -----
    ISO 5348 takes an accelerometer and what holds it for one mass on a spring. Which resonance that gives
    is up to the mounting: some 30 kHz on a stud, several kHz on a magnet, about 2 kHz on a probe held by
    hand. Piezoelectric accelerometers have hardly any damping.

    References
    ----------
    ISO 5348, Mechanical vibration and shock - Mechanical mounting of accelerometers.
    """

    name: A[str, At(longest=80, pattern=r"^[A-Za-z][A-Za-z0-9_]*$"), "of the sensor"] = "axlebox_top"
    position: A[Vector, At("mm"), "from the bearing centre along x, y, z"] = (0.0, 0.0, 0.17)
    # those of config/sensors/piezo_axlebox.yaml
    noise_density: _Noise = 2.9e-4
    range: _Range = 20_000.0
    mounting_resonance: _Resonance = None
    mounting_damping_ratio: _Damping = 0.02
    rate: A[
        float,
        At("kHz"),
        RATE_WORDS,
    ] = RATES[0]
    type: A[
        SensorType | None,
        At(reference=True),
        "a shipped kind, a path, or the keys of one; what the sensor gives itself takes its place",
    ] = None
    sensitivity: _Sensitivity = 0.01
    low_pass: _LowPass = None
    measured_paths: A[tuple[MeasuredPath, ...], "from the rigid box to the sensor"] = ()

    def as_written(self, keys: dict[str, Any]) -> dict[str, Any]:
        """Write the usual damping, too, where the type would give another one."""
        if self.type is not None and self.mounting_damping_ratio != self.type.mounting_damping_ratio:
            keys["mounting_damping_ratio"] = self.mounting_damping_ratio
        return keys

    def rules(self) -> Iterator[str]:
        """Check that the rate is available, and that a damping has a resonance to act on."""
        if self.rate not in ALL_RATES:
            *others, last = (f"{rate / 1e3:g}" for rate in ALL_RATES)
            yield f"rate_kHz is {self.rate / 1e3:g}; allowed is {', '.join(others)} or {last}"
        yield from _damping_of_nothing(self)
        axes = [axis for path in self.measured_paths for axis in path.axes]
        for axis in sorted({axis for axis in axes if axes.count(axis) > 1}):
            yield f"measured_paths has axis {axis!r} twice; give one path for each axis"


def sensor_doubts(sensors: Sequence[Accelerometer], bearing: RollerBearing) -> list[str]:
    """Warn of accelerometers in the bearing itself, or further away than an axlebox reaches."""
    found = []
    for index, sensor in enumerate(sensors):
        x, y, z = sensor.position
        inside = math.hypot(x, z) < 0.5 * bearing.pitch_diameter and abs(y) < 0.5 * bearing.width
        if inside or math.hypot(x, y, z) > FARTHEST:
            where = "inside of the bearing" if inside else f"further than {FARTHEST:g} m from the bearing"
            found.append(f"sensors[{index}].position_mm: {sensor.name} is {where}: check the unit")
    return found


def _damping_of_nothing(sensor: Accelerometer | SensorType) -> Iterator[str]:
    if sensor.mounting_damping_ratio != 0.02 and sensor.mounting_resonance is None:
        yield (
            f"mounting_damping_ratio is {sensor.mounting_damping_ratio:g}; it damps nothing without "
            "mounting_resonance_Hz: give that too, or leave both out for a rigid mounting"
        )


def waveform_rate(sensors: Sequence[Accelerometer]) -> float:
    """Find the rate of the force waveform: that of the sensors, 25.6 kHz where they are faster, [Hz]."""
    return min((RATES[0], *(sensor.rate for sensor in sensors)))


def rates_do_not_fit(sensors: Sequence[Accelerometer]) -> str | None:
    """Say why sensors cannot be sampled together; ``None`` when they can."""
    slow = waveform_rate(sensors)
    if slow == RATES[0]:
        return None
    other = next((sensor for sensor in sensors if sensor.rate != slow), None)
    if other is None:
        return None
    return (
        f"sensor {other.name!r} has {other.rate / 1e3:g} kHz, another one {slow / 1e3:g} kHz; below "
        f"{RATES[0] / 1e3:g} kHz all sensors have one rate"
    )


def steps_do_not_fit(sensors: tuple[Accelerometer, ...], steps_per_sample: float) -> str | None:
    """Say why a time step does not fit the rates of the sensors; ``None`` when it does."""
    fast = [sensor.name for sensor in sensors if sensor.rate > RATES[0]]
    if not fast or (steps_per_sample >= FINE_STEPS and steps_per_sample % 2 == 0):
        return None
    return (
        f"sensor {fast[0]!r} at {RATES[1] / 1e3:g} kHz needs numerics.steps_per_sample of at least "
        f"{FINE_STEPS} and even, not {steps_per_sample}"
    )
