"""What holds the bearing against tilt in its static equilibrium."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.model.mounting import MountingParams
from beardyn_core.scene.mounting import Mounting


def tilt_restraint(mounting: Mounting, parameters: MountingParams) -> NDArray[np.float64]:
    """Work out the stiffness of the suspension against the tilt of the bearing about x and z, [N m/rad].

    A journal free to tilt leans the whole moment on the box, whatever holds that.
    """
    if mounting.cup == "held" or mounting.journal_tilt == "free":
        return np.zeros(2)
    stiffness = parameters.stiffness
    if parameters.coupling is not None:
        # the bearing centre stays where it is, so its springs beside it restrain the tilt too
        stiffness = np.diag(parameters.coupling.stiffness)
    return np.asarray(stiffness)[[3, 5]]
