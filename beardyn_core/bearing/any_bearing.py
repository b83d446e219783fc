"""Bearings of any kind as one type, and the sentence for what only tapered ones have."""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.roller_bearing import KINDS, RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing

AnyBearing = Bearing | CylindricalBearing | SphericalBearing
BEARING_OF_KIND: dict[str, type[RollerBearing]] = dict(
    zip(KINDS, (Bearing, CylindricalBearing, SphericalBearing), strict=True)
)
POSSIBLE = (
    "possible are load distribution, stiffness and rating life (`beardyn bearing`), fault frequencies, "
    "the monitor, runs (`beardyn simulate`) and estimators (`beardyn train`)"
)


def require_tapered(bearing: RollerBearing, what: str, label: str = "bearing") -> Bearing:
    """Give a tapered bearing back; raise `InputError` for one of another kind, naming what it can do.

    Parameters
    ----------
    what : str
        That exists for tapered bearings only, a plural.
    label : str
        Where the bearing was asked for: file, key or option.
    """
    if not isinstance(bearing, Bearing):
        refuse_kind(bearing.name, bearing.kind, what, label)
    return bearing


def refuse_kind(
    name: str, kind: str, what: str, label: str = "bearing", kinds: tuple[str, ...] = (Bearing.kind,)
) -> NoReturn:
    """Raise `InputError`: what was asked for exists for some kinds only; see `require_tapered`."""
    words = BEARING_OF_KIND[kind].words
    raise InputError(
        f"{label}: {name} is a {words}; {what} exist for {' and '.join(kinds)} roller bearings only; "
        f"{POSSIBLE}"
    )


def change_play(
    bearing: RollerBearing, end_play: float | None, radial_clearance: float | None
) -> tuple[RollerBearing, float | None]:
    """Give a bearing another radial clearance, and the end play that statics take for it.

    Parameters
    ----------
    end_play : float or None
        Total axial travel, [m]; ``None``: the bearing's own.
    radial_clearance : float or None
        Total radial travel, [m]; ``None``: the bearing's own.

    Raises
    ------
    InputError
        The kind of bearing does not have what is given.
    """
    if isinstance(bearing, Bearing):
        if radial_clearance is not None:
            raise InputError(
                f"radial_clearance is given, and {bearing.name} is a {bearing.words}; its play is end_play"
            )
        return bearing, bearing.end_play if end_play is None else end_play
    if isinstance(bearing, SphericalBearing) and end_play is not None:
        raise InputError(
            f"end_play is given, and {bearing.name} is a {bearing.words}; its play is radial_clearance"
        )
    if radial_clearance is not None:
        bearing = with_play(bearing, radial_clearance)[0]
    return bearing, end_play


def with_play(bearing: RollerBearing, play: float) -> tuple[RollerBearing, float | None]:
    """Give a bearing the play that its kind has, and the end play that statics take for it.

    Parameters
    ----------
    play : float
        End play of a tapered bearing, radial clearance of the others, [m].
    """
    if isinstance(bearing, RadialBearing):
        return replace(bearing, radial_clearance=play), None
    return bearing, play
