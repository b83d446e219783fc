"""Load ratings and rating life after ISO 281, and from the load of every lamina after ISO 16281."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.roller_bearing import ROW_COUNT, RollerBearing

# of C_0r and of C_r: beyond these a force is refused, or doubted
LARGEST_SHARE, SMALLEST_SHARE = 4.0, 1e-3
_MILLIMETRES = 1.0e3
_SQUARE_MILLIMETRES_PER_SECOND = 1.0e6
# lambda nu of Lundberg and Palmgren: what edges and uneven stress cost a line contact.
LINE_CONTACT_REDUCTION = 0.83
LIFE_EXPONENT = 10.0 / 3.0
MILLION = 1.0e6
# Above this size ISO 281 lowers the fatigue load limit, [mm].
_LARGE_PITCH_DIAMETER = 100.0
_LARGEST_MODIFICATION = 50.0
_LARGEST_VISCOSITY_RATIO = 4.0
_SMALLEST_VISCOSITY_RATIO = 0.1
_BELOW_ALL_FILMS = 0.1
SMALLEST_LAMINA_COUNT = 30
_WEIBULL = 9.0 / 8.0  # slope of line contact; the load exponent of one contact is 4
_ROTATING, _STATIONARY = 4.0, 4.5  # exponents of the mean load of a ring


@dataclass(frozen=True)
class DynamicRating:
    """Dynamic load rating and load factors of the double row, ISO 281."""

    radial: A[float, "C_r of both rows together, [N]"]
    thrust_limit: A[float, "e: thrust ratio up to which Y1 applies, [-]"]
    thrust_low: A[float, "Y1, axial load factor below e, [-]"]
    thrust_high: A[float, "Y2, above e, [-]"]

    def equivalent_load(self, radial: float, axial: float) -> float:
        """Compute the dynamic equivalent radial load P of a radial and an axial force, [N]."""
        axial = abs(axial)
        if self.thrust_low == 0.0 or axial <= self.thrust_limit * radial:
            return radial + self.thrust_low * axial
        return 0.67 * radial + self.thrust_high * axial


def rating_factor(gamma: float) -> float:
    """Compute the factor f_c of a radial roller bearing from gamma = Dwe cos(alpha) / Dpw, [N/mm^(...)].

    References
    ----------
    Lundberg, G. and Palmgren, A. (1952), as tabled in ISO 281: 207.9 lambda nu gamma^(2/9)
    (1 - gamma)^(29/27) / (1 + gamma)^(1/4) {1 + [1.04 ((1 - gamma)/(1 + gamma))^(143/108)]^(9/2)}^(-2/9),
    lambda nu = 0.83.
    """
    rings = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return LINE_CONTACT_REDUCTION * 207.9 * shape * (1.0 + rings**4.5) ** (-2.0 / 9.0)


def rating_gamma(bearing: RollerBearing) -> float:
    """Compute Dwe cos(alpha) / Dpw with the cup angle, the contact angle of the standards, [-]."""
    return bearing.roller_diameter * math.cos(bearing.cup_angle) / bearing.pitch_diameter


def dynamic_rating(bearing: RollerBearing) -> DynamicRating:
    """Compute the dynamic load rating of the double row; the contact angle of ISO 281 is the cup angle.

    Notes
    -----
    A cylindrical roller bearing has no axial factor: for the contact angle 0 the standard takes P = F_r.
    """
    angle = bearing.cup_angle
    diameter = bearing.roller_diameter * _MILLIMETRES
    length = bearing.effective_length * _MILLIMETRES
    radial = (
        bearing.steel_factor
        * rating_factor(rating_gamma(bearing))
        * (ROW_COUNT * length * math.cos(angle)) ** (7.0 / 9.0)
        * bearing.roller_count**0.75
        * diameter ** (29.0 / 27.0)
    )
    if angle == 0.0:
        return DynamicRating(radial, thrust_limit=math.inf, thrust_low=0.0, thrust_high=0.0)
    return DynamicRating(
        radial=radial,
        thrust_limit=1.5 * math.tan(angle),
        thrust_low=0.45 / math.tan(angle),
        thrust_high=0.67 / math.tan(angle),
    )


def static_rating(bearing: RollerBearing) -> float:
    """Compute the static radial load rating C_0r of the double row, [N].

    References
    ----------
    ISO 76 (2006), radial roller bearings: 44 (1 - Dwe cos(alpha) / Dpw) i Z Lwe Dwe cos(alpha), mm.
    """
    length = bearing.effective_length * _MILLIMETRES
    diameter = bearing.roller_diameter * _MILLIMETRES
    count = ROW_COUNT * bearing.roller_count
    return 44.0 * (1.0 - rating_gamma(bearing)) * count * length * diameter * math.cos(bearing.cup_angle)


def load_doubts(bearing: RollerBearing, force: Sequence[float]) -> tuple[str, str]:
    """State why a force of three components [N] is implausible for a bearing.

    Returns
    -------
    problem, doubt : str
        Why it cannot be carried, and why it is probably not what was meant; empty when there is no reason.

    Notes
    -----
    Line contact pressure grows with the root of the load. At C_0r it is 4 GPa (ISO 76) and leaves marks that
    can be measured; at four times of it, twice that pressure, is the hardness of bearing steel, about 8 GPa.
    Bearings under less than a thousandth of C_r do not roll: catalogues ask for a fiftieth of C_r.
    """
    size, limit = math.hypot(*force), static_rating(bearing)
    if not size <= LARGEST_SHARE * limit:
        return (
            f"the force is {size:.4g} N, {size / limit:.3g} times the static load rating of {bearing.name} "
            f"({limit / 1e3:.0f} kN); allowed is up to {LARGEST_SHARE:g} times, where steel yields: "
            "check the unit",
            "",
        )
    if size > limit:
        return "", (
            f"the force is {size / 1e3:.4g} kN, more than the static load rating of {bearing.name} "
            f"({limit / 1e3:.0f} kN), above which its raceways keep marks"
        )
    rating = dynamic_rating(bearing).radial
    if 0.0 < size < SMALLEST_SHARE * rating:
        return "", (
            f"the force is {size:.4g} N, less than a thousandth of the dynamic load rating of {bearing.name} "
            f"({rating / 1e3:.0f} kN): check the unit"
        )
    if math.isfinite(bearing.largest_thrust) and (tipping := _tipping_thrust(bearing, *force)):
        return "", tipping
    return "", ""


def _tipping_thrust(bearing: RollerBearing, x: float, y: float, z: float) -> str:
    """State that the axial part of a force [N] is more than rollers can take, empty when it is not."""
    across, along = math.hypot(x, z), abs(y)
    if along <= bearing.largest_thrust * across:
        return ""
    return (
        f"the axial force of {along / 1e3:.4g} kN is more than {bearing.largest_thrust:g} of the radial "
        f"one ({across / 1e3:.4g} kN): rollers of a {bearing.words} tip, and catalogues allow no more; "
        "the equivalent load of ISO 281 leaves the axial force out, so its lives do not hold"
    )


def fatigue_load_limit(bearing: RollerBearing) -> float:
    """Compute the fatigue load limit C_u of the double row, [N].

    References
    ----------
    ISO 281 (2007), Annex B, simplified method for roller bearings: C_0r / 8.2, above 100 mm pitch diameter
    times (100 / Dpw)^0.3.
    """
    pitch = bearing.pitch_diameter * _MILLIMETRES
    return static_rating(bearing) / 8.2 * min(1.0, (_LARGE_PITCH_DIAMETER / pitch) ** 0.3)


def reference_viscosity(bearing: RollerBearing, speed: float) -> float:
    """Compute the kinematic viscosity nu_1 that gives an adequate film at a shaft speed [rad/s], [m^2/s].

    References
    ----------
    ISO 281 (2007), 45000 n^-0.83 Dpw^-0.5 below 1000 rpm, 4500 n^-0.5 Dpw^-0.5 above, mm^2/s.
    """
    rpm = abs(speed) * 30.0 / math.pi
    pitch = bearing.pitch_diameter * _MILLIMETRES
    if rpm == 0.0:
        return math.inf
    scale = 45_000.0 * rpm**-0.83 if rpm < 1000.0 else 4500.0 * rpm**-0.5
    return scale / math.sqrt(pitch) / _SQUARE_MILLIMETRES_PER_SECOND


def life_modification(viscosity_ratio: float, contamination: float, limit_ratio: float) -> float:
    """Compute the life modification factor a_ISO of radial roller bearings, [-].

    Parameters
    ----------
    viscosity_ratio : float
        kappa: viscosity over the reference viscosity; ratios above 4 count as 4, below 0.1, where the film is
        thinner than the standard covers, a_ISO is 0.1; it is 50 at most.
    contamination : float
        e_C: 1 for extreme cleanliness, 0 for heavy contamination.
    limit_ratio : float
        Fatigue load limit over equivalent load, C_u / P.

    References
    ----------
    ISO 281 (2007), Eq. 34 to 36.
    """
    if viscosity_ratio < _SMALLEST_VISCOSITY_RATIO:
        return _BELOW_ALL_FILMS
    kappa = min(viscosity_ratio, _LARGEST_VISCOSITY_RATIO)
    if kappa < 0.4:
        film = 1.5859 - 1.3993 / kappa**0.054381
    elif kappa < 1.0:
        film = 1.5859 - 1.2348 / kappa**0.19087
    else:
        film = 1.5859 - 1.2348 / kappa**0.071739
    # the rounded constants leave -1e-4 at kappa 0.1
    stress = max(film, 0.0) * (contamination * limit_ratio) ** 0.4
    if stress >= 1.0:
        return _LARGEST_MODIFICATION
    return min(0.1 * (1.0 - stress) ** -9.185, _LARGEST_MODIFICATION)


def basic_rating_life(rating: float, equivalent_load: float) -> float:
    """Compute the basic rating life L_10, [revolutions]; infinite without load.

    References
    ----------
    ISO 281 (2007): (C_r / P)^(10/3) million revolutions.
    """
    if equivalent_load <= 0.0:
        return math.inf
    return MILLION * (rating / equivalent_load) ** LIFE_EXPONENT


def edge_concentration(lamina_count: int) -> Float:
    """Compute the factor on the load per length of each lamina in the rating life of a profiled roller, [-].

    It is 1.002 near the middle and 2.33 at both ends. For life alone: it is no load and has no place in the
    equilibrium. Laminae that are coupled already carry part of the concentration; use one of the two.

    References
    ----------
    ISO/TS 16281:2008, stress riser of rollers:
    f[k] = 1 - 0.01 / ln(1.985 |(2k - n - 1)/(2n - 2)|), k = 1 to n.
    """
    if lamina_count < 2:
        raise ValueError(f"lamina_count is {lamina_count}; the ends of a roller need at least 2 laminae.")
    number = np.arange(1, lamina_count + 1)
    place = np.abs(2 * number - lamina_count - 1) / (2.0 * lamina_count - 2.0)
    with np.errstate(divide="ignore"):  # the middle lamina of an odd count: ln 0, factor 1
        factor: Float = 1.0 - 0.01 / np.log(1.985 * place)
    return factor


@dataclass(frozen=True)
class ReferenceLife:
    """Reference rating life of one load."""

    basic: A[float, "L_10r, [revolutions]"]
    modified: A[float, "L_10mr with lubrication and contamination, [revolutions]"]
    equivalent_load: A[float, "P_ref,r = C_r / (L_10r / 10^6)^(3/10), [N]"]
    lamina_life: A[
        Float, "shape [row, lamina], basic life of each lamina of a row, both raceways, [revolutions]"
    ]


def contact_ratings(bearing: RollerBearing) -> tuple[float, float]:
    """Compute the dynamic load ratings Q_ci and Q_ce of one roller on cone and cup, [N].

    References
    ----------
    ISO/TS 16281 (2008), roller bearings; C_r of both rows, i = 2.
    """
    gamma = rating_gamma(bearing)
    rings = (1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)) ** 4.5
    radial = dynamic_rating(bearing).radial / LINE_CONTACT_REDUCTION
    share = radial / (bearing.roller_count * ROW_COUNT ** (7.0 / 9.0) * math.cos(bearing.cup_angle))
    cone = share / 0.378 * (1.0 + rings) ** (2.0 / 9.0)
    cup = share / 0.364 * (1.0 + 1.0 / rings) ** (2.0 / 9.0)
    return cone, cup


def reference_life(
    bearing: RollerBearing, cup_load: Float, cone_load: Float, viscosity_ratio: float, contamination: float
) -> ReferenceLife:
    """Compute the basic and modified reference rating life; the cone turns, the load direction is fixed.

    Parameters
    ----------
    cup_load, cone_load : float64 arrays, shape [row, roller, lamina]
        Load of each lamina, [N]; at least 30 laminae for a life by the standard.
    viscosity_ratio, contamination : float
        kappa and e_C, as in `life_modification`.

    Notes
    -----
    The life modification of a lamina takes the equivalent load of a bearing of which every lamina is loaded
    like it, at the fourth-power law of one contact.

    References
    ----------
    ISO/TS 16281 (2008), roller bearings: ratings and mean loads of the laminae, their lives added with the
    Weibull slope 9/8.
    """
    lamina_count = cup_load.shape[2]
    scale = float(lamina_count) ** (-7.0 / 9.0)
    cone_rating, cup_rating = (scale * rating for rating in contact_ratings(bearing))
    edge = edge_concentration(lamina_count)
    cone_mean = np.mean((edge * cone_load) ** _ROTATING, axis=1) ** (1.0 / _ROTATING)
    cup_mean = np.mean((edge * cup_load) ** _STATIONARY, axis=1) ** (1.0 / _STATIONARY)
    damage = (cone_mean / cone_rating) ** (4.0 * _WEIBULL) + (cup_mean / cup_rating) ** (4.0 * _WEIBULL)
    total = float(damage.sum())
    rating = dynamic_rating(bearing).radial
    with np.errstate(divide="ignore"):
        lamina_life = MILLION * damage ** (-1.0 / _WEIBULL)
        alike = (ROW_COUNT * lamina_count * damage) ** (0.25 / _WEIBULL) * rating / LINE_CONTACT_REDUCTION
    limit = fatigue_load_limit(bearing)
    modification = np.array(
        [
            life_modification(viscosity_ratio, contamination, limit / load) if load > 0.0 else math.inf
            for load in alike.ravel()
        ]
    ).reshape(alike.shape)
    modified = float((damage * modification**-_WEIBULL).sum())
    basic_life = MILLION * total ** (-1.0 / _WEIBULL) if total > 0.0 else math.inf
    modified_life = MILLION * modified ** (-1.0 / _WEIBULL) if modified > 0.0 else math.inf
    equivalent = rating * (MILLION / basic_life) ** 0.3
    return ReferenceLife(basic_life, modified_life, equivalent, lamina_life)
