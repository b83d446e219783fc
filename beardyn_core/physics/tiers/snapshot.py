"""What a run is frozen in and goes on from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.slow_thermal import Warmth
from beardyn_core.physics.tiers.cage_watch import CageWatch
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.state import State
from beardyn_core.rail.load_buffer import LoadBuffer


@dataclass(frozen=True)
class Snapshot:
    """Everything the rest of a run depends on."""

    index: int  # of the next block
    state: State
    parameters: Parameters
    load: LoadBuffer
    observer: Any  # a copy, with the states of all filters
    first_audit: NDArray[np.float64] | None  # [ENERGY_TERMS], energies at the start of the run [J]
    warmth: Warmth | None = None
    cages: CageWatch | None = None
