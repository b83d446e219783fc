"""Vibration of the wheel over its angle: flats, polygons and all else that turns with the shaft."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Bool, Float
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.features import hann

SECTORS = 64
# power of a sector over that of the usual one: a strike, and its ringing next to it
_STRIKE, _RINGING = 10.0, 1.3
_ONSET, _RISE = 6.0, 3  # power of a strike over that of the sector so many before or after
# least share of a quartile in the mean over the revolutions where the wheel strikes
_STEADY = 0.1
_LEAST_REVOLUTIONS = 8.0  # of which a quartile distinguishes strikes from noise


def struck_sectors(stretch: Stretch, settings: MonitorSettings) -> Bool:
    """Find the sectors of the wheel where it strikes the rail in three of four revolutions, shape [sector].

    They begin at the shaft angle at the start of the stretch.

    Notes
    -----
    A sector is struck where the lower quartile of its power over the revolutions is ten times that of the
    usual sector in one of the bands, and no small part of the mean there; sectors nearby that still ring, as
    steadily, belong to it. A flat comes back at the same angle each time. A spall on the cone is loud in one
    half of the revolution too, but its strikes lie elsewhere in each: between them the quartile stays low, or
    where they ring long, far below the mean. Of a wide spall, in which rollers are half of the time, it does
    not; but the load zone, in which the cone is loud, comes slowly, and a strike at once: from one sector to
    the third after it flats rise by 11 and more, spalls of 12 mm by 4 at most.

    One band does not do: a box may ring at any frequency, and a strike that goes unnoticed is as loud as the
    rollers stand well for it at that moment. They come back to the same place by a fraction of a revolution,
    so its lines lie at whole orders plus and minus that of BPFO, where those of BPFI with their sidebands
    are: the two orders add up to the number of rollers.
    """
    bands = settings.strike_bands
    if bands not in stretch.struck:
        stretch.struck[bands] = _find_struck(stretch, bands)
    return stretch.struck[bands]


def _find_struck(stretch: Stretch, bands: tuple[tuple[float, float], ...]) -> Bool:
    turned = (stretch.shaft_angle - stretch.shaft_angle[0]) / (2.0 * np.pi)
    revolutions = int(turned[-1])
    if revolutions < _LEAST_REVOLUTIONS:
        return np.zeros(SECTORS, dtype=bool)
    edges = np.searchsorted(turned, np.arange(revolutions * SECTORS + 1) / SECTORS)
    struck = np.zeros(SECTORS, dtype=bool)
    for low, high in bands:
        if low < 0.5 * stretch.rate:
            power = stretch.squared_envelope((low, min(high, 0.5 * stretch.rate)))
            sums = np.concatenate(([0.0], np.cumsum(power)))
            means = np.diff(sums[edges]) / np.maximum(np.diff(edges), 1)
            struck |= _struck_in(means.reshape(revolutions, SECTORS))
    return struck


def _struck_in(power: Float, known: Bool | bool = False) -> Bool:
    """Find the struck sectors in the power of one band, shape [revolution, sector], next to known ones."""
    quartile = np.quantile(power, 0.25, axis=0)
    usual = np.median(quartile)
    steady = quartile > _STEADY * np.mean(power, axis=0)
    # before or after: of a shaft that turns back, whose time is reversed, ringing comes first
    slowly = np.minimum(np.roll(quartile, _RISE), np.roll(quartile, -_RISE))
    at_once = quartile > _ONSET * slowly
    struck = known | (steady & at_once & (quartile > _STRIKE * usual))
    ringing = steady & (quartile > _RINGING * usual)
    while True:
        more = struck | (ringing & (np.roll(struck, 1) | np.roll(struck, -1)))
        if np.array_equal(more, struck):
            return np.asarray(more)
        struck = more


def quiet_samples(stretch: Stretch, settings: MonitorSettings) -> Bool:
    """Tell the samples between the ramps where the wheel does not strike, shape [sample]."""
    turned = (stretch.shaft_angle - stretch.shaft_angle[0]) / (2.0 * np.pi)
    sector = np.minimum((turned % 1.0 * SECTORS).astype(int), SECTORS - 1)
    quiet = ~struck_sectors(stretch, settings)[sector]
    quiet[: stretch.inner.start] = quiet[stretch.inner.stop :] = False
    return quiet


def without_wheel(power: Float, struck: Bool, loud: Float | None = None) -> Float:
    """Subtract the wheel's own pattern from power, or from a measure of how loud it is; 0 where it strikes.

    The power, shape [revolution, step], is the squared envelope over the angle of the shaft, in a multiple of
    `SECTORS` steps. Its mean over the revolutions at each angle holds all that comes back with the shaft:
    every whole order. No bearing fault has one. The mean is weighted as `order_spectrum` does: with equal
    weights a single knock near an end of the stretch would be lines at every whole order. In a narrow band
    the wheel rings longer than where its strikes were found, and may strike where it did not elsewhere.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal Process.
    25, section 3.1 (time synchronous averaging).
    """
    weight = hann(power.size).reshape(power.shape)
    loud = power if loud is None else loud
    rest = loud - np.sum(weight * loud, axis=0) / np.sum(weight, axis=0)
    if len(power) >= _LEAST_REVOLUTIONS:
        struck = _struck_in(power.reshape(len(power), SECTORS, -1).mean(axis=2), struck)
    rest[:, np.repeat(struck, power.shape[1] // SECTORS)] = 0.0
    return rest
