"""Kernel parameters of coupled laminae."""

from __future__ import annotations

import numpy as np

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.joint_lamina import part_exponent
from beardyn_core.bearing.lamina_coupling import bearing_lamina_root
from beardyn_core.effects import LaminaCoupling
from beardyn_core.model.aligned import aligned_zeros
from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.contact_parameters import COUPLING_ROWS, CouplingParams


def coupling_params(
    bearing: Bearing, coupling: LaminaCoupling | None, count: int, arrangement: Arrangement
) -> CouplingParams | None:
    """Matrices and work space for `count` laminae, or ``None`` without the effect."""
    if coupling is None:
        return None
    matrices = bearing_lamina_root(bearing, coupling, count)
    own = np.diag(matrices.stiffness).copy()
    follow = -matrices.stiffness / own[:, None]
    np.fill_diagonal(follow, 0.0)
    return CouplingParams(
        root=np.ascontiguousarray(matrices.root),
        follow=np.ascontiguousarray(follow),
        own_stiffness=own,
        part_exponent=part_exponent(coupling.strength),
        work=aligned_zeros(COUPLING_ROWS, count, arrangement.width),
    )
