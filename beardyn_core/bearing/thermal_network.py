"""Temperatures of the parts of an axlebox bearing as a network of lumped nodes.

C dT/dt = q - G (T - T_ambient), with one heat capacity per node and conductances between nodes and to the
air. The step is exact for heat that is constant over it, so it may be as long as one likes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class ThermalNetwork:
    """Nodes with capacities, conductances between them and to the ambient."""

    capacity: A[Float, "shape [node], [J/K]"]
    conductance: A[Float, "shape [node, node], symmetric, between two nodes; the diagonal is not used, [W/K]"]
    to_ambient: A[Float, "shape [node], [W/K]"]

    @property
    def matrix(self) -> Float:
        """G: heat that leaves each node per kelvin of every node above the ambient, [W/K]."""
        between = self.conductance - np.diag(np.diag(self.conductance))
        return np.diag(between.sum(axis=1) + self.to_ambient) - between

    def steady(self, heat: Float, ambient: float) -> Float:
        """Compute the steady temperatures, at which as much heat leaves as comes in, [K]."""
        return ambient + np.asarray(np.linalg.solve(self.matrix, heat))

    def after(self, temperature: Float, heat: Float, ambient: float, duration: float) -> Float:
        """Compute the temperatures after a duration [s] with constant heat into each node [W], [K]."""
        root = np.sqrt(self.capacity)
        rates, modes = np.linalg.eigh(self.matrix / np.outer(root, root))
        final = self.steady(heat, ambient)
        away = modes.T @ (root * (temperature - final))
        return final + (modes @ (np.exp(-rates * duration) * away)) / root
