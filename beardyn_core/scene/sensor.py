"""Sensors on the axlebox."""

from __future__ import annotations

from dataclasses import dataclass

RATES = (25_600.0, 51_200.0)  # [Hz]
FINE_STEPS = 8  # fewest time steps per sample of 25.6 kHz that resolve the band of the faster rate


@dataclass(frozen=True)
class Accelerometer:
    """A three-axis accelerometer screwed to the axlebox.

    Parameters
    ----------
    name : str
    position : tuple of 3 floats
        From the bearing centre, world axes, [m].
    noise_density : float
        White noise, one-sided, [m/s^2/sqrt(Hz)].
    range : float
        Clipping level of each axis, [m/s^2].
    mounting_resonance : float or None
        Of the accelerometer on its mounting, undamped, in each axis, [Hz]; ``None`` for a rigid one.
    mounting_damping_ratio : float
        Of critical damping; the gain at the resonance is 1 over twice of it, [-].
    rate : float
        Out of `RATES`, [Hz].

    Notes
    -----
    ISO 5348 takes an accelerometer and what holds it for one mass on a spring. Which resonance that gives
    is up to the mounting: some 30 kHz on a stud, several kHz on a magnet, about 2 kHz on a probe held by
    hand. Piezoelectric accelerometers have hardly any damping.

    References
    ----------
    ISO 5348, Mechanical vibration and shock - Mechanical mounting of accelerometers.
    """

    name: str = "axlebox_top"
    position: tuple[float, float, float] = (0.0, 0.0, 0.17)
    noise_density: float = 0.02
    range: float = 5000.0
    mounting_resonance: float | None = None
    mounting_damping_ratio: float = 0.02
    rate: float = RATES[0]


def steps_do_not_fit(sensors: tuple[Accelerometer, ...], steps_per_sample: float) -> str | None:
    """Why a time step cannot serve the sensors, with what is allowed; ``None`` when it can."""
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
