"""Load and pressure along one roller: what a tilt, a profile and the coupling of laminae do to its ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from beardyn_core.bearing.contact_law import LINE_EXPONENT, line_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lamina_coupling import coupled_law
from beardyn_core.effects import LaminaCoupling
from beardyn_core.effects.lamina_coupling import bearing_lamina_root
from beardyn_core.physics.lamina_table import lamina_places, lamina_pressure

Float = NDArray[np.float64]


@dataclass(frozen=True)
class LineLoad:
    """One raceway contact of a roller, lamina by lamina from the small to the large end."""

    place: Float  # [lamina], abscissa from mid-length [m]
    load_per_length: Float  # [lamina], [N/m]
    pressure: Float  # [lamina], Hertz pressure in the middle of the contact's width [Pa]
    approach: float  # of roller and ring at mid-length, profile drop not taken off [m]
    moment: float  # of the load about mid-length, positive when the large end carries more [N m]


def line_load(
    bearing: Bearing,
    load: float,
    tilt: float = 0.0,
    *,
    ring: str = "cup",
    laminae: int = 30,
    coupling: LaminaCoupling | None = None,
) -> LineLoad:
    """Distribute a load along a roller that is tilted against a raceway.

    Parameters
    ----------
    load : float
        Of the contact, [N].
    tilt : float
        Between the roller's generator and the raceway, positive when the large end is pressed deeper, [rad].
    ring : str
        ``cup`` or ``cone``.
    coupling : LaminaCoupling or None
        Coupling of the laminae.

    Notes
    -----
    Without coupling a straight, aligned roller is loaded evenly whatever happens at its ends; with coupling
    its ends carry more, and the more the finer the laminae: the pressure under a sharp end has no limit.
    """
    place = lamina_places(bearing, laminae)
    material, length = bearing.material, bearing.effective_length
    factor = line_contact_factor(material, length) / laminae
    drop = bearing.profile.lamina_drop(laminae, length, bearing.roller_diameter, material.contact_modulus)
    matrices = None if coupling is None else bearing_lamina_root(bearing, coupling, laminae)

    def loads(approach: float) -> Float:
        depth = approach + tilt * place - drop
        if matrices is None:
            force: Float = factor * np.maximum(depth, 0.0) ** LINE_EXPONENT
            return force
        return coupled_law(depth, factor, matrices)[0]

    # one lamina that touches bounds the approach from below; each carrying the whole load, from above
    lowest = float(np.min(drop - tilt * place))
    highest = float(np.max(drop - tilt * place)) + (load / factor) ** (1.0 / LINE_EXPONENT)
    approach = brentq(lambda a: float(loads(a).sum()) - load, lowest, highest, xtol=1e-16, rtol=1e-14)
    found = loads(approach)
    return LineLoad(
        place=place,
        load_per_length=found * laminae / length,
        pressure=lamina_pressure(bearing, found, ring),
        approach=float(approach),
        moment=float(found @ place),
    )
