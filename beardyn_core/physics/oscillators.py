"""Masses and dampers with which steps of a mode have its exact free motion."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float

_RESOLVED = 0.5 * math.pi  # rate of a mode times the step up to which its motion is exact: four steps a turn


def exact_oscillators(rate: Float, damping_ratio: Float, step: float) -> tuple[Float, Float, Float]:
    """Find masses and dampers with which steps of unit modal masses have the exact free motion.

    Parameters
    ----------
    rate, damping_ratio : array, shape [mode]
        Undamped rate, [rad/s].
    step : float
        [s].

    Returns
    -------
    mass, damping, inertia : arrays, shape [mode]
        Damping in [1/s]; inertia is the mass with half a step of the damping.

    Notes
    -----
    With velocities half a step after positions and the damper in the middle, q obeys q+ = q + (q - q-) r^2 -
    k (q - F/w^2) for the roots z = r exp(+-i t) when k = 1 + r^2 - 2 r cos(t): r = exp(-d x) and t =
    x sqrt(1 - d^2), x = w h, are the exact ones, and a constant force F moves the mode by F/w^2. A mode with
    less than four steps a turn gets the mass x^2 / 2 and rings with four: right at rest, late, and far enough
    from the limit k = 4 that contacts, which add to it, leave it stable.
    """
    x, ratio = rate * step, np.minimum(damping_ratio, 1.0)
    resolved = x < _RESOLVED
    x = np.where(resolved, x, 1.0)
    decay = np.exp(-2.0 * ratio * x)
    turn = 1.0 + decay - 2.0 * np.sqrt(decay) * np.cos(x * np.sqrt(1.0 - ratio**2))
    inertia = np.where(resolved, x**2 / turn, ratio * rate * step + 0.5 * (rate * step) ** 2)
    half = np.where(resolved, inertia * 0.5 * (1.0 - decay), ratio * rate * step)
    return inertia - half, 2.0 * half / step, inertia
