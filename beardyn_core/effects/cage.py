"""Cage of each row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class PocketFilm:
    """Lubricant between the rollers and the bars of their pockets, as an option of `Cage`.

    Viscosity is the lubricant's at the scene's temperature.

    Parameters
    ----------
    switch_thickness : float
        Thickness to which the film can be squeezed, about the roughness of the pocket; what is pressed
        further is carried by the pocket's stiffness on top of the film, [m].
    layer : float
        Thickness of the lubricant on the faces: wider gaps are not bridged, [m].
    """

    about: ClassVar[About] = About(
        adds="Films between rollers and cage bars: wedge, squeeze and shear, elastic below a thickness.",
        states="none",
        cost="low",
        validity="Isoviscous, rigid, isothermal; no film at the pocket ends; the squeeze resistance of a "
        "pocket is bounded by what the explicit cage can follow in a step.",
        source="Martin (1916); Reynolds' equation for squeeze and shear of a cylinder near a plane",
    )

    switch_thickness: float = 2.0e-6
    layer: float = 50.0e-6


@dataclass(frozen=True)
class LandGuidance:
    """Land of each cage in a cylinder of cup or cone, as an option of `Cage`.

    Parameters
    ----------
    on : str
        ``cup``: the cage runs inside a land of the cup; ``cone``: around one of the cone.
    clearance : float
        Radial, [m].
    land_width : float
        [m].
    land_diameter : float or None
        ``None``: pitch diameter and half a roller diameter more on the cup, less on the cone, [m].
    land_offset : float or None
        Of the land outward from the cage's centre; ``None``: above the large roller ends, [m].
    friction : float
        Coefficient of friction of the edges, when they touch.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    """

    about: ClassVar[About] = About(
        adds="Guidance of each cage by a land: short journal bearing, solid contact of both land edges.",
        states="none",
        cost="low",
        validity="Flooded isoviscous film with half the clearance cavitated; tilt only in the solid contact; "
        "edges as stiff as a pocket.",
        source="Dubois and Ocvirk (1953); Vance (1988), ch. 6, for whirl and squeeze; Petroff for the drag",
    )

    on: Literal["cup", "cone"] = "cup"
    clearance: float = 0.3e-3
    land_width: float = 4.0e-3
    land_diameter: float | None = None
    land_offset: float | None = None
    friction: float = 0.1
    regularisation_speed: float = 0.1


@dataclass(frozen=True)
class Cage:
    """Cage of each row as a rigid body, touched by every roller in its pocket.

    Parameters
    ----------
    friction : float
        Coefficient of friction between roller and pocket.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    bar_inclination : float
        Angle of the bar faces against the radial plane: the bars stand outside the pitch circle, so the
        rollers also guide the cage radially, [rad].
    initial_speed_ratio : float
        Cage and roller orbit speed at the start over the kinematic one.
    pocket_wear : float
        What wear adds to the circumferential clearance of every pocket, [m].
    lubrication : PocketFilm or None
        ``None``: the pockets are dry.
    guidance : LandGuidance or None
        ``None``: the rollers alone guide the cage.
    """

    about: ClassVar[About] = About(
        adds="Cage of each row in six degrees of freedom, touched by every roller in its pocket.",
        states="12 positions and 12 velocities",
        cost="high",
        validity="Rigid cage; pocket contacts are springs with damping, dry unless lubricated.",
        source="Disc-on-plane contact of both bars and both pocket ends",
    )

    friction: float = 0.08
    regularisation_speed: float = 0.1
    bar_inclination: float = 0.44
    initial_speed_ratio: float = 1.0
    pocket_wear: float = 0.0
    lubrication: PocketFilm | None = None
    guidance: LandGuidance | None = None


@dataclass(frozen=True)
class RotatingCage:
    """Cage of each row that turns and otherwise stays between cup and cone: one degree of freedom.

    What pushes it across goes to cup and cone, half each. The bars stand along the radius; no pocket ends.

    Parameters
    ----------
    friction, regularisation_speed, initial_speed_ratio, pocket_wear : float
        As in `Cage`.
    """

    about: ClassVar[About] = About(
        adds="Cage of each row with its spin as the only freedom, touched by the rollers at the bars.",
        states="2 angles and 2 speeds",
        cost="medium",
        validity="Cage speed and skid; no whirl and no axial motion of the cage.",
        source="Disc-on-plane contact of the nearer bar",
    )

    friction: float = 0.08
    regularisation_speed: float = 0.1
    initial_speed_ratio: float = 1.0
    pocket_wear: float = 0.0


@dataclass(frozen=True)
class KinematicCage:
    """Cage of each row at a prescribed speed, to which weak springs hold the rollers.

    For quick spectra: fault and ball-pass lines stand where rolling without slip has them, and nothing is
    computed of the cage. The work of the prescribed speed counts as external.

    Parameters
    ----------
    speed_ratio : float
        Speed of the cage over that of rolling without slip.
    stiffness : float
        Along the pitch circle, of one roller at its place, [N/m].
    damping : float
        The same, [N s/m].
    """

    about: ClassVar[About] = About(
        adds="Rollers held by weak springs at the pockets of a cage of prescribed speed.",
        states="none",
        cost="medium",
        validity="Loads, kinematics and spectra under load; no skid, no cage dynamics, no pocket forces.",
        source="Epicyclic speed of the cage; Harris and Kotzalas (2006), ch. 10",
    )

    speed_ratio: float = 1.0
    stiffness: float = 1.0e5
    damping: float = 100.0

    @property
    def initial_speed_ratio(self) -> float:
        """Cage and roller orbit speed at the start over the kinematic one."""
        return self.speed_ratio


CageModel = Cage | RotatingCage | KinematicCage
