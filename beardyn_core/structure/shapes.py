"""Modes at nodes, as another program has computed them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.arrays import Float


@dataclass(frozen=True)
class Shapes:
    """Modes at nodes, unit modal mass, in the frame of their file."""

    nodes: A[Float, "shape [node, 3], in the file's unit of length"]
    frequency: A[Float, "shape [mode], [Hz]"]
    damping_ratio: A[Float, "shape [mode], 0 where the file has none"]
    shape: A[Float, "shape [mode, node, 3], [1/sqrt(unit of mass)]"]
