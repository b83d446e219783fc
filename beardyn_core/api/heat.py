"""Steady temperatures and losses by source, for which a run would need hours."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from beardyn_core.api.making import scene
from beardyn_core.choice import heat_interval as interval
from beardyn_core.choice import steady_heat as found
from beardyn_core.choice.heat_interval import HeatInterval
from beardyn_core.choice.steady_heat import SteadyHeat
from beardyn_core.scene.scene import Scene


def steady_heat(source: str | Path | Mapping[str, Any] | Scene, **options: Any) -> SteadyHeat:
    """Find the temperatures at which a bearing in its axlebox stays, and what it loses there.

    Parameters
    ----------
    source : str, Path, mapping or Scene
        As of `beardyn_core.scene`. Options of its effect ``thermal`` are those of the axlebox in the air, or
        the usual ones; ``effects="all"`` has every loss.
    **options
        Other arguments of `beardyn_core.scene`.

    Returns
    -------
    SteadyHeat
        ``rise("axlebox")``, of cup, cone, rollers, cages or grease above the air [K], ``torque`` by source
        [N m], ``power`` [W], ``end_play`` [m]; ``settles`` is false where the bearing runs away.

    Raises
    ------
    InputError, ValidityError
        An argument makes no sense; there is no equilibrium or no steady state.

    References
    ----------
    See `beardyn_core.choice.steady_heat`.
    """
    return found.steady_heat(scene(source, **options))


def heat_interval(source: str | Path | Mapping[str, Any] | Scene, **options: Any) -> HeatInterval:
    """Find the steady temperatures of a bearing as 90 % intervals over grease, seals and air.

    Parameters
    ----------
    source : str, Path, mapping or Scene
        As of `steady_heat`, which is solved 15 times.
    **options
        Other arguments of `beardyn_core.scene`.

    Returns
    -------
    HeatInterval
        ``rise("axlebox")``: least, usual and most above the air [K]; ``inputs``: what each assumed input
        does; ``warm_from(air)``: a limit for the monitor [K].

    Raises
    ------
    InputError, ValidityError
        An argument makes no sense; there is no equilibrium or no steady state.

    References
    ----------
    See `beardyn_core.choice.heat_interval`.
    """
    return interval.heat_interval(scene(source, **options))
