"""Slow references of coupled laminae: a minimiser of the same energy, and the half-space itself."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import dblquad
from scipy.optimize import brentq, minimize

Float = NDArray[np.float64]


def by_minimiser(depth: Float, factor: float, root: Float) -> tuple[Float, float]:
    """Loads and energy: surface above the roller everywhere, energy of independent springs least."""
    scale = float(np.max(depth))
    if scale <= 0.0:
        return np.zeros_like(depth), 0.0

    def energy(surface: Float) -> tuple[float, Float]:
        own = root @ surface
        return float(9.0 / 19.0 * np.sum(np.abs(own) ** (19.0 / 9.0))), root @ (
            np.abs(own) ** (1.0 / 9.0) * own
        )

    found: Any = minimize(
        energy,
        np.maximum(depth, 0.0) / scale,
        jac=True,
        method="L-BFGS-B",
        bounds=[(d / scale, None) for d in depth],
        options={"ftol": 1e-16, "gtol": 1e-13, "maxiter": 10000, "maxcor": 40},
    )
    load = factor * scale ** (10.0 / 9.0) * energy(found.x)[1]
    return np.where(found.x > depth / scale + 1e-9, 0.0, load), factor * scale ** (19.0 / 9.0) * found.fun


def influence_by_quadrature(distance: float, length: float, half_width: float, modulus: float) -> float:
    """Boussinesq's 1/r integrated over a uniformly pressed rectangle, both bodies, per load."""
    integral, _ = dblquad(
        lambda y, x: 1.0 / np.hypot(x, y),
        distance - 0.5 * length,
        distance + 0.5 * length,
        -half_width,
        half_width,
        epsrel=1e-8,
    )
    return float(integral) / (np.pi * 0.5 * modulus * 2.0 * half_width * length)


def on_half_space(depth: Float, influence: Float, total: float, approach: float) -> Float:
    """Loads of delta_k = a F_k^0.9 + sum of C_kj F_j over the others, F >= 0.

    ``a`` gives a uniformly approached line its total at one approach (Palmgren).
    """
    others = influence - np.diag(np.diag(influence))

    def loads(depths: Float, own: float) -> Float:
        load = np.full(len(depths), total / len(depths))
        for _ in range(5000):
            before = load.copy()
            for k in range(len(load)):
                left = depths[k] - others[k] @ load
                load[k] = (left / own) ** (10.0 / 9.0) if left > 0.0 else 0.0
            if np.max(np.abs(load - before)) < 1e-11 * total:
                break
        return load

    uniform = np.full(len(depth), approach)
    own = brentq(lambda log_a: loads(uniform, np.exp(log_a)).sum() - total, np.log(1e-11), np.log(1e-7))
    return loads(depth, np.exp(own))
