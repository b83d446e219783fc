"""Blind deconvolution: the filter behind which one order is as strong as any filter can make it.

The filter h maximises the share of the power s^2 of its output s = X h that comes and goes with the harmonics
of an order: with W the part of s^2 that lies on them, on the diagonal, the largest eigenvalue of
X'WX h = l X'X h. W follows from h, so this is repeated. Where in the tolerance the order lies is looked up
again each time. It starts from linear prediction, behind which all frequencies weigh alike.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh, solve

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.features import order_spectrum, resample_by_angle

TAPS = 48
ROUNDS = 5
GRID = 128  # steps of a revolution: more than twice the highest order that is sought
_WEAKEST = 1e-9  # power that every frequency is given, of the mean


def deconvolved(stretch: Stretch, order: float, settings: MonitorSettings) -> Float:
    """Filter the first axis so that power comes and goes with an order, shape [sample].

    References
    ----------
    Buzzoni, Antoni, D'Elia (2018), Blind deconvolution based on cyclostationarity maximization and its
    application to fault identification, J. Sound Vib. 432, section 3 (the criterion and its iteration).
    """
    signal = (stretch.acceleration[:, 0] - stretch.acceleration[:, 0].mean()) * stretch.ramp
    padded = np.concatenate((np.zeros(TAPS - 1), signal))
    delayed = np.ascontiguousarray(np.lib.stride_tricks.sliding_window_view(padded, TAPS))
    every = delayed.T @ delayed
    every[np.diag_indices(TAPS)] *= 1.0 + _WEAKEST
    taps = solve(every, np.eye(TAPS)[-1], assume_a="pos")
    for _ in range(ROUNDS):
        power = (delayed @ taps) ** 2
        found = strongest_near(power, stretch, order, settings)
        weight = on_harmonics(power, found * stretch.shaft_angle, settings.harmonics)
        struck = delayed.T @ (weight[:, None] * delayed)
        taps = eigh(struck, every, subset_by_index=(TAPS - 1, TAPS - 1))[1][:, 0]
    return np.asarray(delayed @ taps, np.float64)


def strongest_near(power: Float, stretch: Stretch, order: float, settings: MonitorSettings) -> float:
    """Find the order within the tolerance whose harmonics are strongest in power, shape [sample]."""
    highest = settings.harmonics * order * (1.0 + settings.tolerance)
    steps = resample_by_angle(power, stretch.shaft_angle, GRID)
    found = order_spectrum(steps, GRID, highest, settings.background_width)
    half = settings.tolerance * order
    trial = np.arange(order - half, order + half, 0.25 * found.resolution / settings.harmonics)
    index = np.rint(trial[:, None] * np.arange(1, settings.harmonics + 1) / found.order[1]).astype(int)
    level = 10.0 ** (0.1 * found.level)
    return float(trial[level[np.minimum(index, len(level) - 1)].sum(axis=1).argmax()])


def on_harmonics(power: Float, angle: Float, harmonics: int) -> Float:
    """Take the part of power that lies on the harmonics of an angle [rad], both of shape [sample]."""
    turning = np.exp(1j * angle)
    phase, part = np.ones_like(turning), np.zeros(len(power))
    for _ in range(harmonics):
        phase *= turning
        part += 2.0 * (np.vdot(phase, power) / len(power) * phase).real
    return part
