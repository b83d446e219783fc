"""Envelope and order tracking: from vibration in time to power over the angle of the shaft."""

from __future__ import annotations

from beardyn_core.arrays import Float
from beardyn_core.observe.chain.inputs import MonitorSettings, Stretch
from beardyn_core.observe.chain.kurtogram import Band
from beardyn_core.observe.chain.wheel import struck_sectors, without_wheel
from beardyn_core.observe.features import resample_by_angle


def squared_envelope(stretch: Stretch, band: Band) -> Float:
    """Compute the squared envelope of the band, summed over the axes.

    Returns
    -------
    float64 array, shape [sample]
        [m^2/s^4].

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 4.3: the squared envelope has no harmonics of its own making.
    """
    return stretch.squared_envelope((band.low, band.high))


def by_angle(power: Float, stretch: Stretch, settings: MonitorSettings) -> Float:
    """Resample power over equal steps of the shaft angle, whole revolutions, less the wheel's own part.

    Parameters
    ----------
    power : float64 array, shape [sample]
        Squared envelope.

    Returns
    -------
    float64 array, shape [step]
    """
    count = settings.samples_per_revolution
    steps = resample_by_angle(power, stretch.shaft_angle, count)
    whole = len(steps) // count
    struck = struck_sectors(stretch, settings)
    return without_wheel(steps[: whole * count].reshape(whole, count), struck).reshape(-1)
