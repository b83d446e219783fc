"""Defects of raceways and rollers."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Spall:
    """A patch of missing material on a raceway or a roller.

    Parameters
    ----------
    on : str
        ``cup``, ``cone`` or ``roller``.
    row : int
        0 inboard, 1 outboard.
    azimuth : float
        Centre, from +z towards +x, in the body's own frame (the cone's and the roller's at the start
        of the run; a roller's 0 faces the cup), [rad].
    width : float
        Extent in rolling direction, [m].
    depth : float
        Depth, [m].
    length : float
        Extent along the roller, [m].
    offset : float
        Centre along the roller from the middle of its effective length, positive towards the large
        end, [m].
    roller : int
        Which roller, for ``on='roller'``.
    """

    on: str
    row: int
    azimuth: float
    width: float
    depth: float
    length: float
    offset: float = 0.0
    roller: int = 0
