"""What a run is frozen in and goes on from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.integrate.state import State
from beardyn_core.integrate.warming import Warmth
from beardyn_core.model.parameters import Parameters
from beardyn_core.scene.load_buffer import LoadBuffer


@dataclass(frozen=True)
class Snapshot:
    """Everything the rest of a run depends on.

    Parameters
    ----------
    index : int
        Of the next block.
    state : State
    parameters : Parameters
    load : LoadBuffer
    observer : Observer
        A copy, with the states of all filters.
    first_audit : float64 array or None, shape [ENERGY_TERMS]
        Energies at the start of the run, [J].
    warmth : Warmth or None
    """

    index: int
    state: State
    parameters: Parameters
    load: LoadBuffer
    observer: Any
    first_audit: NDArray[np.float64] | None
    warmth: Warmth | None = None
