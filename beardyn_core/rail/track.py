"""Lumped track: what the wheel feels of a rail on pads, sleepers, ballast and subgrade."""

from __future__ import annotations

from dataclasses import dataclass

from beardyn_core.scene.operation import Track


@dataclass(frozen=True)
class LumpedTrack:
    """Chain rail - pad - sleeper - ballast - subgrade under the wheel.

    Parameters
    ----------
    mass : tuple of 3 floats
        Rail, sleepers, ballast, [kg].
    stiffness : tuple of 3 floats
        Below rail, sleepers, ballast, [N/m].
    damping : tuple of 3 floats
        Below rail, sleepers, ballast, [N s/m].
    """

    mass: tuple[float, float, float]
    stiffness: tuple[float, float, float]
    damping: tuple[float, float, float]

    @property
    def point_stiffness(self) -> float:
        """Static stiffness under the wheel, [N/m]."""
        return 1.0 / sum(1.0 / stiffness for stiffness in self.stiffness)


def lump(track: Track) -> LumpedTrack:
    """Equivalent chain of a beam on an elastic foundation.

    The static deflection of the beam under a point load, exp(-b x)(cos b x + sin b x), is taken as
    the shape of the motion: a length 2 / b of foundation carries the load, and a length 3 / (2 b) of
    rail, sleepers and ballast moves along.

    Parameters
    ----------
    track : Track

    Returns
    -------
    LumpedTrack

    Notes
    -----
    Has the static point stiffness of the beam and about its first resonance with the wheel; waves
    that run away in the rail (radiation damping above about 300 Hz) and the pinned-pinned mode near
    1 kHz are neglected.

    References
    ----------
    Hetenyi (1946), Beams on Elastic Foundation, chapter 2; Jenkins et al. (1974), The effect of
    track and vehicle parameters on wheel/rail vertical dynamic forces, for the moving mass 3 m / (2 b).
    """
    seats = (track.pad_stiffness, track.ballast_stiffness, track.subgrade_stiffness)
    modulus = 1.0 / sum(1.0 / stiffness for stiffness in seats) / track.sleeper_spacing
    b = (modulus / (4.0 * track.rail_bending_stiffness)) ** 0.25
    carrying = 2.0 / b / track.sleeper_spacing
    moving = 1.5 / b
    return LumpedTrack(
        mass=(
            track.rail_mass_per_length * moving,
            track.sleeper_mass * moving / track.sleeper_spacing,
            track.ballast_mass * moving / track.sleeper_spacing,
        ),
        stiffness=(seats[0] * carrying, seats[1] * carrying, seats[2] * carrying),
        damping=(
            track.pad_damping * carrying,
            track.ballast_damping * carrying,
            track.subgrade_damping * carrying,
        ),
    )
