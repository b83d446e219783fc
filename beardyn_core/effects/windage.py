"""Air drag of the turning cages."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar, NamedTuple

from beardyn_core.base.edge import At
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects.about import About

AIR_PRESSURE = 101325.0  # [Pa]
AIR_CONSTANT = 287.05  # [J/(kg K)]
# Torque of a cylinder that turns in another, over pi rho w^2 r^4 L / 2: factors and powers of the Reynolds
# number of the gap for laminar flow, Taylor vortices and turbulence, all times (gap / radius)^0.3.
ANNULUS = ((10.0, 1.0), (2.0, 0.6), (1.03, 0.5), (0.065, 0.2))
# Torque of both sides of a disc, over rho w^2 r^5 / 2: laminar and turbulent.
DISC = ((3.87, 0.5), (0.146, 0.2))
DISC_TRANSITION = 3.0e5  # Reynolds number
_CAGE_THICKNESS = 0.2  # over the roller diameter, assumed
_WIDEST_CAGE = 0.9  # over the roller diameter: what is wider leaves no gap to the rings
_SLOWEST = 1.0e-9  # for the logarithm, [rad/s]


class Annulus(NamedTuple):
    """Torque between two cylinders at 1 rad/s in each kind of flow, [N m]."""

    laminar: float
    vortices: float
    more_vortices: float
    turbulent: float


class WindageParams(NamedTuple):
    """Air around one cage."""

    outside: Annulus  # between cage and cup
    inside: Annulus  # between cage and cone
    faces_laminar: float  # torque of both end faces at 1 rad/s [N m]
    faces_turbulent: float
    transition: float  # speed at which the end faces have half of each [rad/s]


@dataclass(frozen=True)
class Windage:
    """Air drag of each cage: its outside against the cup, its inside against the cone, its end faces."""

    about: ClassVar[About] = About(
        loss="windage",
        heat={"grease": 1.0},
        needs=("cage",),
        adds="Air drag of the turning cages: mantles in the gaps to cup and cone, end faces in free air.",
        states="none",
        cost="medium",
        validity="Smooth cages in air, no grease in the gaps that the rollers leave them. Small: 0.5 W for "
        "both at a shaft speed of 300 rad/s, below a thousandth of what the bearing loses.",
        source="Bilgen and Boulos (1973), annulus; von Karman (1921), disc; Sutherland (1893), viscosity",
    )

    density: A[
        float | None,
        At("kg_per_m3", gt=0.0, le=1000.0),
        "of air with grease mist; dry air at the scene's temperature if not given",
    ] = None
    thickness: A[
        float | None, At("mm", gt=0.0), "of the cage, along the radius; a fifth of a roller if not given"
    ] = None
    factor: A[float, At(gt=0.0, le=100.0), "drag over that of a smooth ring: bars and pockets are rough"] = (
        1.0
    )

    def parameters(self, bearing: RollerBearing, temperature: float) -> WindageParams:
        """Work out torques at 1 rad/s for a cage on the pitch circle, as long as its rollers; [K]."""
        viscosity = air_viscosity(temperature)
        density = self.density or air_density(temperature)
        kinematic = viscosity / density
        thickness = self.thickness or _CAGE_THICKNESS * bearing.roller_diameter
        if thickness > _WIDEST_CAGE * bearing.roller_diameter:
            raise InputError(
                f"effects.windage: thickness_mm is {1e3 * thickness:g}; it must be at most "
                f"{1e3 * _WIDEST_CAGE * bearing.roller_diameter:.3g}, {_WIDEST_CAGE:g} of a roller"
            )
        pitch, length = 0.5 * bearing.pitch_diameter, bearing.roller_length * math.cos(bearing.contact_angle)
        gap = 0.5 * (bearing.roller_diameter - thickness)
        outer, inner = pitch + 0.5 * thickness, pitch - 0.5 * thickness
        laminar, turbulent = (
            self.factor * (disc(place, density, kinematic, outer) - disc(place, density, kinematic, inner))
            for place in range(2)
        )
        of_air = density * self.factor
        return WindageParams(
            outside=annulus(outer, gap, length, of_air, kinematic),
            inside=annulus(inner - gap, gap, length, of_air, kinematic),
            faces_laminar=laminar,
            faces_turbulent=turbulent,
            transition=DISC_TRANSITION * kinematic / outer**2,
        )

    @staticmethod
    def cage_law(from_cup: float, from_cone: float, parameters: WindageParams) -> tuple[float, float]:
        """Work out the torques of cup and cone on one cage, see `air_torques`."""
        return air_torques(from_cup, from_cone, parameters)


def air_viscosity(temperature: float) -> float:
    """Compute the dynamic viscosity of air at `temperature` [K], [Pa s]; Sutherland's law."""
    return 1.458e-6 * temperature**1.5 / (temperature + 110.4)


def air_density(temperature: float) -> float:
    """Compute the density of dry air at `temperature` [K] and normal pressure, [kg/m^3]."""
    return AIR_PRESSURE / (AIR_CONSTANT * temperature)


def annulus(radius: float, gap: float, length: float, density: float, viscosity: float) -> Annulus:
    """Work out the torques between two cylinders at 1 rad/s.

    Parameters
    ----------
    radius : float
        Of the inner cylinder, [m].
    gap, length : float
        [m].
    density : float
        [kg/m^3].
    viscosity : float
        Kinematic, [m^2/s].

    References
    ----------
    Bilgen, E. and Boulos, R. (1973), Functional dependence of torque coefficient of coaxial cylinders on gap
    width and Reynolds numbers, ASME J. Fluids Eng. 95, 122: C = M / (pi rho w^2 r^4 L / 2) over
    Re = w r t / nu, t the gap: (t/r)^0.3 times 10/Re, 2/Re^0.6, 1.03/Re^0.5, 0.065/Re^0.2; the next one from
    Re = 64, 500 and 1e4 on.
    """
    unit = 0.5 * math.pi * density * radius**4 * length * (gap / radius) ** 0.3
    reynolds = radius * gap / viscosity
    return Annulus(*(unit * factor * reynolds**-power for factor, power in ANNULUS))


def disc(kind: int, density: float, viscosity: float, radius: float) -> float:
    """Work out the torque on both sides of a disc at 1 rad/s in laminar (0) or turbulent flow (1), [N m].

    Kinematic viscosity [m^2/s].

    References
    ----------
    von Karman, T. (1921), Z. angew. Math. Mech. 1, 233, with the number of Cochran (1934); Schlichting, H.,
    Boundary-layer theory, ch. V and XXI, rotating disk: C = 2 M / (rho w^2 r^5 / 2) = 3.87 Re^-1/2 up to
    Re = w r^2 / nu = 3e5, 0.146 Re^-1/5 above.
    """
    factor, power = DISC[kind]
    return 0.5 * density * radius**5 * factor * (radius**2 / viscosity) ** -power


def air_torques(from_cup: float, from_cone: float, air: WindageParams) -> tuple[float, float]:
    """Work out the torque of the air on one cage, from the cup's side and from the cone's, [N m].

    The end faces count to the cup, which the air in the axlebox rests on. Kinds of flow of a gap are blended
    by the 16th power of their torques: the largest counts, and where two are alike up to 4.4 % more. Those of
    the end faces change over within a factor of two of the speed. Neglects the rollers in the pockets and
    that the cone turns too, which makes the flow inside more stable.

    Parameters
    ----------
    from_cup, from_cone : float
        Speed of the cage against them, [rad/s].
    air : WindageParams

    Returns
    -------
    tuple of float
        Signed as the speeds.
    """
    outer, inner = abs(from_cup) + _SLOWEST, abs(from_cone) + _SLOWEST
    ratio = (outer / air.transition) ** 4
    share = ratio / (1.0 + ratio)
    laminar, turbulent = outer * math.sqrt(outer), math.exp(1.8 * math.log(outer))
    faces = (1.0 - share) * air.faces_laminar * laminar + share * air.faces_turbulent * turbulent
    outside = faces + annulus_torque(outer, air.outside)
    return outside * from_cup / outer, annulus_torque(inner, air.inside) * from_cone / inner


def annulus_torque(speed: float, air: Annulus) -> float:
    """Work out the torque between two cylinders at some speed, [rad/s], [N m]."""
    log = math.log(speed)
    vortices, turbulent = air.vortices * math.exp(1.4 * log), air.turbulent * math.exp(1.8 * log)
    laminar, more_vortices = air.laminar * speed, air.more_vortices * speed * math.sqrt(speed)
    most = max(max(laminar, vortices), max(more_vortices, turbulent))
    share = 1.0 / most
    total = (laminar * share) ** 16 + (vortices * share) ** 16
    total += (more_vortices * share) ** 16 + (turbulent * share) ** 16
    return most * math.sqrt(math.sqrt(math.sqrt(math.sqrt(total))))
