"""Sensors on the axlebox."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At, Vector

RATES = (25_600.0, 51_200.0)  # [Hz]
FINE_STEPS = 8  # fewest time steps per sample of 25.6 kHz that resolve the band of the faster rate


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
    noise_density: A[float, At("m_per_s2_per_sqrt_Hz", ge=0.0), "white noise of each axis, one-sided"] = 0.02
    range: A[float, At("m_per_s2", gt=0.0), "clipping level of each axis"] = 5000.0
    mounting_resonance: A[
        float | None,
        At("Hz", gt=0.0, ge=500.0, le=100_000.0),
        "of the accelerometer on its mounting (ISO 5348); rigid when left out",
    ] = None
    mounting_damping_ratio: A[
        float, At(gt=0.0, ge=0.001, le=0.9, absent=True), "of critical; 0.02 when left out"
    ] = 0.02
    rate: A[
        float,
        At("kHz"),
        f"51.2 needs an even numerics.steps_per_sample of {FINE_STEPS} or more, its default then",
    ] = RATES[0]

    def rules(self) -> Iterator[str]:
        """Check that the rate is available, and that a damping has a resonance to act on."""
        if self.rate not in RATES:
            allowed = f"{RATES[0] / 1e3:g} or {RATES[1] / 1e3:g}"
            yield f"rate_kHz is {self.rate / 1e3:g}; allowed is {allowed}"
        if self.mounting_damping_ratio != 0.02 and self.mounting_resonance is None:
            yield (
                f"mounting_damping_ratio is {self.mounting_damping_ratio:g}; it damps nothing without "
                "mounting_resonance_Hz: give that too, or leave both out for a rigid mounting"
            )


def steps_do_not_fit(sensors: tuple[Accelerometer, ...], steps_per_sample: float) -> str | None:
    """Say why a time step does not fit the rates of the sensors; ``None`` when it does."""
    resonant = [sensor.name for sensor in sensors if sensor.mounting_resonance is not None]
    if resonant and steps_per_sample < 1:
        return (
            f"sensor {resonant[0]!r} with a mounting resonance needs numerics.steps_per_sample of at least "
            f"1, not {steps_per_sample}"
        )
    fast = [sensor.name for sensor in sensors if sensor.rate > RATES[0]]
    if not fast or (steps_per_sample >= FINE_STEPS and steps_per_sample % 2 == 0):
        return None
    return (
        f"sensor {fast[0]!r} at {RATES[1] / 1e3:g} kHz needs numerics.steps_per_sample of at least "
        f"{FINE_STEPS} and even, not {steps_per_sample}"
    )
