"""Cage of each row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar, Literal

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import POCKET_HEAT, About, SlipSpeed

PocketFriction = A[float, SHARE, "coefficient of friction between roller and pocket"]
InitialSpeedRatio = A[
    float, At(ge=0.0, le=2.0), "speed of cages and rollers at the start over the kinematic one"
]
PocketWear = A[float, At("mm", ge=0.0, le=5.0), "added to the circumferential clearance of every pocket"]


@dataclass(frozen=True)
class PocketFilm:
    """Lubricant between the rollers and the bars of their pockets.

    Viscosity is the lubricant's at the scene's temperature.
    """

    about: ClassVar[About] = About(
        loss="pocket",
        heat=POCKET_HEAT,
        adds="Films between rollers and cage bars: wedge, squeeze and shear, elastic below a thickness.",
        states="none",
        cost="low",
        validity="Isoviscous, rigid, isothermal; no film at the pocket ends; the squeeze resistance of a "
        "pocket is bounded by what explicit cage and rollers can follow in a step, on one bar at a time.",
        source="Martin (1916); Reynolds' equation for squeeze and shear of a cylinder near a plane",
    )

    switch_thickness: A[float, At("um", gt=0.0, le=100.0), "below it the pocket's stiffness carries"] = 2.0e-6
    layer: A[float, At("um", gt=0.0, le=2000.0), "of lubricant on the faces; wider gaps are not bridged"] = (
        50.0e-6
    )


@dataclass(frozen=True)
class LandGuidance:
    """Land of each cage in a cylinder of cup or cone."""

    about: ClassVar[About] = About(
        loss="cage_land",
        heat={"cages": 0.5, "cup": 0.25, "cone": 0.25},
        adds="Guidance of each cage by a land: short journal bearing, solid contact of both land edges.",
        states="none",
        cost="low",
        validity="Flooded isoviscous film with half the clearance cavitated; tilt only in the solid contact; "
        "edges as stiff as a pocket.",
        source="Dubois and Ocvirk (1953); Vance (1988), ch. 6, for whirl and squeeze; Petroff for the drag",
    )

    on: A[Literal["cup", "cone"], "inside a land of the cup, or around one of the cone"] = "cup"
    clearance: A[float, At("mm", gt=0.0), "radial"] = 0.3e-3
    land_width: A[float, At("mm", gt=0.0), "along the bearing axis"] = 4.0e-3
    land_diameter: A[
        float | None,
        At("mm", gt=0.0),
        "pitch diameter and half a roller diameter more (cup) or less (cone) if not given",
    ] = None
    land_offset: A[
        float | None, At("mm"), "outward from the cage's centre; above the large roller ends if not given"
    ] = None
    friction: A[float, SHARE, "coefficient of friction of the edges, when they touch"] = 0.1
    regularisation_speed: SlipSpeed = 0.1


@dataclass(frozen=True)
class Cage:
    """Cage of each row as a rigid body, touched by every roller in its pocket."""

    kind: ClassVar[str] = "six_dof"
    about: ClassVar[About] = About(
        loss="pocket",
        heat=POCKET_HEAT,
        adds="Cage of each row in six degrees of freedom, touched by every roller in its pocket.",
        states="12 positions and 12 velocities",
        cost="high",
        validity="Rigid cage; pocket contacts are springs with damping, dry unless lubricated.",
        source="Disc-on-plane contact of both bars and both pocket ends",
    )

    friction: PocketFriction = 0.08
    regularisation_speed: SlipSpeed = 0.1
    bar_inclination: A[float, At("deg", ge=0.0, lt=90.0), "of the bar faces against the radial plane"] = 0.44
    initial_speed_ratio: InitialSpeedRatio = 1.0
    pocket_wear: PocketWear = 0.0
    lubrication: A[PocketFilm | None, At(switch=True), "film in the pockets; dry without it"] = None
    guidance: A[
        LandGuidance | None, At(switch=True), "by a land of cup or cone; by the rollers alone without it"
    ] = None


@dataclass(frozen=True)
class RotatingCage:
    """Cage of each row that turns and otherwise stays between cup and cone: one degree of freedom.

    What pushes it across goes to cup and cone, half each. The bars stand along the radius; no pocket ends.
    """

    kind: ClassVar[str] = "rotating"
    about: ClassVar[About] = About(
        loss="pocket",
        heat=POCKET_HEAT,
        adds="Cage of each row with its spin as the only freedom, touched by the rollers at the bars.",
        states="2 angles and 2 speeds",
        cost="medium",
        validity="Cage speed and skid; no whirl and no axial motion of the cage.",
        source="Disc-on-plane contact of the nearer bar",
    )

    friction: PocketFriction = 0.08
    regularisation_speed: SlipSpeed = 0.1
    initial_speed_ratio: InitialSpeedRatio = 1.0
    pocket_wear: PocketWear = 0.0


@dataclass(frozen=True)
class KinematicCage:
    """Cage of each row at a prescribed speed, to which weak springs hold the rollers.

    For quick spectra: fault and ball-pass lines stand where rolling without slip has them, and nothing is
    computed of the cage. The work of the prescribed speed counts as external.
    """

    kind: ClassVar[str] = "kinematic"
    about: ClassVar[About] = About(
        loss="pocket",
        heat=POCKET_HEAT,
        adds="Rollers held by weak springs at the pockets of a cage of prescribed speed.",
        states="none",
        cost="medium",
        validity="Loads, kinematics and spectra under load; no skid, no cage dynamics, no pocket forces.",
        source="Epicyclic speed of the cage; Harris and Kotzalas (2006), ch. 10",
    )

    speed_ratio: A[float, At(ge=0.0, le=2.0), "of the cage over that of rolling without slip"] = 1.0
    stiffness: A[float, At("MN_per_m", gt=0.0, le=10.0), "along the pitch circle, of one roller"] = 1.0e5
    damping: A[float, At("N_s_per_m", ge=0.0, le=1000.0), "along the pitch circle, of one roller"] = 100.0

    @property
    def initial_speed_ratio(self) -> float:
        """Cage and roller orbit speed at the start over the kinematic one."""
        return self.speed_ratio


CageModel = Cage | RotatingCage | KinematicCage
