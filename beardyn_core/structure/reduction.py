"""The fewest coordinates with which a box answers right: free modes, and residual modes for the rest.

Free modes up to a frequency leave out how all higher ones yield under a constant load, of a ring under
rollers most of what it yields at all. What they leave out of the answers to loads at the seats becomes
residual modes, which are orthogonal to the others and have frequencies above theirs (Rubin 1975).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from scipy.linalg import eigh

from beardyn_core.base.arrays import Float
from beardyn_core.structure.elastic import Elastic, stack_functionals

_DEPENDENT = 1e-10  # of the largest: directions that the loads before have given already


@dataclass(frozen=True)
class Reduced:
    """Modes with unit modal mass, as seen at raceways and seats."""

    frequency: A[Float, "shape [mode], [Hz]"]
    seen: A[Float, "shape [read, mode], what the functionals read of each, [1/sqrt(kg)]"]
    free: A[Float, "shape [unknown, free mode], shapes of the free modes, which are the first"]


def reduce_body(body: Elastic, names: tuple[str, ...], highest: float, waves: int) -> Reduced:
    """Reduce a body to free modes up to a frequency [Hz] and residual modes.

    Parameters
    ----------
    names : tuple of str
        Seats that are read and loaded.
    waves : int
        Residual modes answer radial loads on a row with up to so many waves around it exactly.

    References
    ----------
    Rubin (1975), Improved component-mode representation for structural dynamic analysis, AIAA J. 13.
    """
    frequency, shapes = body.modes(highest)
    read = stack_functionals(body, names)
    loads = np.concatenate([_patterns(body, waves), *(body.seats[name] for name in names)]).T
    static = body.bent(loads)
    seen_by_modes = shapes.T @ loads
    left = static - shapes @ (seen_by_modes / (2.0 * np.pi * frequency[:, None]) ** 2)
    stiffness = left.T @ (body.stiffness @ left)
    mass = left.T @ (body.mass @ left)
    # each load counts alike, whatever yields to it
    scale = 1.0 / np.sqrt(np.diag(stiffness))
    size, turn = np.linalg.eigh(scale[:, None] * stiffness * scale)
    basis = scale[:, None] * turn[:, size > _DEPENDENT * size.max()]
    squares, mix = eigh(basis.T @ stiffness @ basis, basis.T @ mass @ basis)
    residual = left @ (basis @ mix)
    return Reduced(
        np.concatenate([frequency, np.sqrt(squares) / (2.0 * np.pi)]),
        read @ np.concatenate([shapes, residual], axis=1),
        shapes,
    )


def _patterns(body: Elastic, waves: int) -> Float:
    """List radial loads on both rows with up to so many waves, and thrust all round."""
    half = (body.raceway.shape[2] - 1) // 2
    series = [0, *range(1, waves + 1), *range(half + 1, half + waves + 1)]
    radial = body.raceway[:, 0, series].reshape(-1, body.raceway.shape[-1])
    return np.concatenate([radial, body.raceway[:, 2, 0]])
