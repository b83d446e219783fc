"""Films, starvation, inlet heating and traction: formulas and kernels.

The numbers of D-BRAIN (NSK) are those of the unit tests in its public repository, kojik-umich/D-BRAIN,
gtest/src/Mechanics/TribologyTest.cpp, where the inputs stand too.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache, partial

import numpy as np

from beardyn_core.bearing.film_thickness import (
    line_film,
    thermal_factor,
    thermal_loading,
)
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.effects import CoulombTraction, LineFilm, LoadSharingTraction, MixedTraction
from beardyn_core.effects.traction import Traction
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import LAMINA_PRESSURE
from beardyn_core.physics.film import FilmParams
from beardyn_core.physics.film_traction import aihara_params
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.traction import LoadSharingParams
from evidence.standard import standard_scene
from evidence.validation.anchor import Anchor
from evidence.validation.ball_contact import (
    point_film_central,
    point_film_minimum,
    starvation_central,
    starvation_minimum,
)
from test.kernels.casting import through
from test.kernels.entries import frictions

SANTOS = "Santos 2017"
EQ_8 = "Santos 2017, Eq. 8 with 0.1 and 0.02, derived, digits as printed"
D_BRAIN = "D-BRAIN unit tests (NSK core technology), TribologyTest.cpp"
WORKED = "derived, worked example: 2000 rpm, 10 kN, L055 at 100 deg C; two digits"
HALF_WIDTH = 76.762e-6  # of the ball's contact, along the entrainment, m
KGF_PER_MM2 = 9.80665e6
NO_ASPERITIES = -200.0  # log2 of a roughness that leaves the film all the load
ROUGHNESS = 3e-7


@cache
def parameters(traction: Traction, film: LineFilm | None) -> Parameters:
    """Build the kernel parameters of the 80 kN scene with this friction."""
    scene = standard_scene("static_80kN")
    scene = replace(scene, effects=replace(scene.effects, traction=traction, film=film))
    return build_parameters(scene, Arrangement(17, 8), np.zeros(6))


def film_of(p: Parameters) -> FilmParams:
    """Return the film parameters of a parameter set that has a film."""
    assert p.effects.film is not None
    return p.effects.film


def sharing_of(p: Parameters) -> LoadSharingParams:
    """Return the load-sharing parameters of a parameter set that has them."""
    assert p.effects.load_sharing is not None
    return p.effects.load_sharing


def film_and_friction(p: Parameters, load: float, slip: float, speed: float) -> tuple[float, float]:
    """Return film thickness [m] and friction over normal load of a lamina, from the kernel.

    Load in N, slip and entrainment speed in m/s; the kernel adds 1 mm/s to the entrainment speed.
    """
    case = np.array([[load, slip**2, speed - 1e-3]])
    found = through(Lanes(1), frictions, case, 2, 2, 0, p)[0]
    return 2.0 ** float(found[0]), float(found[1] * slip / load)


def coefficient(p: Parameters, load: float, slip: float, speed: float) -> float:
    """Return friction over normal load."""
    return film_and_friction(p, load, slip, speed)[1]


def boundary_blend() -> Parameters:
    """Compute the blend with Ambrosio's regularisation on a surface too rough for a film."""
    p = parameters(MixedTraction(regularisation="ambrosio"), LineFilm())
    return p._replace(effects=p.effects._replace(film=film_of(p)._replace(roughness=1e-3)))


def dry() -> Parameters:
    """Return the dry friction with Ambrosio's regularisation: full from its speed on."""
    return parameters(CoulombTraction(regularisation="ambrosio"), None)


def mixed_coefficient(film_parameter: float) -> float:
    """Compute Eq. 8 at full slip (20 m/s) and the entrainment speed that gives this film parameter."""
    p = parameters(MixedTraction(), LineFilm(supply="flooded"))
    load = 1000.0
    # the film grows with speed^0.7
    speed = 5.0 * (film_parameter * ROUGHNESS / film_and_friction(p, load, 20.0, 5.0)[0]) ** (1.0 / 0.7)
    return coefficient(p, load, 20.0, speed)


def aihara_coefficient(pressure: float, slip: float, speed: float) -> float:
    """Return the traction of a film without asperities under a largest pressure in kgf/mm2, speeds in m/s."""
    p = parameters(LoadSharingTraction(inlet_shear=False), LineFilm(supply="flooded"))
    oil = load_lubricant("L055")
    oil = replace(oil, density=oil.density * 72.9029224284153e-3 / oil.dynamic_viscosity(343.15))
    aihara = aihara_params(oil, 343.15, LoadSharingTraction().largest_slide, p.laminae)
    sharing = sharing_of(p)._replace(aihara=aihara, log2_roughness=NO_ASPERITIES)
    p = p._replace(effects=p.effects._replace(load_sharing=sharing))
    mean_pressure = math.pi / 4.0 * pressure * KGF_PER_MM2
    return coefficient(p, mean_pressure**2 / p.laminae[LAMINA_PRESSURE, 2], slip, speed)


AIHARA = (
    (149.980489558372, 48.8863222878130e-3, 896.117562552404e-3, 6.017253174237477e-2),
    (70.8668300974355, 18.7016744160132e-3, 904.002621182389e-3, 9.483619302366691e-3),
)


def film_share(film_parameter: float) -> float:
    """Return the part of the load on the film: here it shears without stress, the asperities with 0.1."""
    p = parameters(LoadSharingTraction(film_traction="bair_winer", inlet_shear=False), LineFilm())
    sharing = sharing_of(p)
    assert sharing.bair_winer is not None
    film = film_and_friction(p, 500.0, 1.0, 5.0)[0]
    sharing = sharing._replace(
        slope=1e9,
        log2_roughness=math.log2(film / film_parameter),
        bair_winer=sharing.bair_winer._replace(limiting_shear=1e-12),
    )
    p = p._replace(effects=p.effects._replace(load_sharing=sharing))
    return 1.0 - coefficient(p, 500.0, 1.0, 5.0) / 0.1


def ball_on_inner_ring() -> tuple[float, float]:
    """Return central film and radius Rx of D-BRAIN's HamrockDowson_case1, at the epicyclic ball spin, m."""
    ball, race, groove, steel = 4.365e-3, 40.635e-3, 2.3571e-3, 207e9 / (1.0 - 0.3**2)
    radius_x, radius_y = 1.0 / (2.0 / ball + 1.0 / race), 1.0 / (2.0 / ball - 1.0 / groove)
    pitch = 2.0 * race + ball
    spin = 0.5 * (pitch / ball - ball / pitch) * 1e4 * math.pi / 30.0
    speed = 0.5 * ball * spin
    film = point_film_central(136.0, speed, radius_x, radius_y, steel, 43.691e-3, 0.2 / 9.8067e6)
    return film, radius_x


def starvation_of_the_ball() -> float:
    """Return the starved over the flooded film of the ball on its inner ring, [-]."""
    film, radius = ball_on_inner_ring()
    return starvation_central(film, radius, HALF_WIDTH, HALF_WIDTH)


def example_film(side: str, formula: str = "dowson_higginson") -> float:
    """Compute the film of HS130x230 at 2000 rpm, 10 kN on a roller, L055 at 100 deg C, m."""
    bearing, oil = load_bearing("HS130x230"), load_lubricant("L055")
    shaft = 2000.0 * math.pi / 30.0
    angle = {"cup": bearing.cup_angle, "cone": bearing.cone_angle}[side]
    distance, raceway = (
        bearing.contact_distance,
        {"cup": bearing.cup_radius, "cone": bearing.cone_radius}[side],
    )
    # cup at rest: its contact point moves with the cage, so both surfaces enter with w_c R
    orbit = cage_speed(bearing, shaft)
    speed = (orbit if side == "cup" else shaft - orbit) * raceway
    curvature = 1.0 / (distance * math.tan(bearing.half_angle))
    curvature += (-1.0 if side == "cup" else 1.0) / (distance * math.tan(angle))
    return line_film(
        1e4 / bearing.effective_length, speed, 1.0 / curvature, bearing.material.contact_modulus,
        oil.dynamic_viscosity(373.15), oil.pressure_viscosity_at(373.15), formula,
    )  # fmt: skip


LINE_FILMS = (
    ("dowson_higginson", 0.38),
    ("pan_hamrock", 0.345),
    ("pan_hamrock_central", 0.41),
    ("dowson_toyoda", 0.49),
)

ANCHORS = (
    Anchor(
        "dry friction",
        "dry friction over normal force at 5 m/s of slip",
        0.100,
        "",
        SANTOS,
        lambda: coefficient(dry(), 800.0, 5.0, 5.0),
        tolerance=1e-6,
    ),
    Anchor(
        "dry friction",
        "the same of the blend without a film",
        0.100,
        "",
        SANTOS,
        lambda: coefficient(boundary_blend(), 800.0, 5.0, 5.0),
        tolerance=1e-6,
    ),
    *(
        Anchor(
            "mixed friction",
            f"mixed friction at a film parameter of {film_parameter:g}",
            friction,
            "",
            EQ_8,
            partial(mixed_coefficient, film_parameter),
            absolute=digits,
        )
        for film_parameter, friction, digits in (
            (0.1, 0.075, 5e-4),
            (0.3, 0.042, 5e-4),
            (0.5, 0.027, 5e-4),
            (1.0, 0.0201, 5e-5),
        )
    ),
    *(
        Anchor(
            "mixed friction",
            f"share of the film in the load at a film parameter of {film_parameter:g}",
            share,
            "",
            "derived, 1 - exp(-1.8 Lambda^1.2), two digits",
            partial(film_share, film_parameter),
            absolute=0.0055,
        )
        for film_parameter, share in ((0.3, 0.35), (0.5, 0.54), (1.0, 0.84), (1.5, 0.95), (2.0, 0.98))
    ),
    *(
        Anchor(
            "film thickness",
            f"film of {formula} on the cone",
            film,
            "um",
            WORKED,
            partial(lambda formula: 1e6 * example_film("cone", formula), formula),
            tolerance=0.05,
        )
        for formula, film in LINE_FILMS
    ),
    Anchor(
        "film thickness",
        "central film of Hamrock and Dowson, flooded",
        1.33431846824466,
        "um",
        D_BRAIN,
        lambda: 1e6 * ball_on_inner_ring()[0],
        tolerance=1e-5,
        beside=True,
    ),
    Anchor(
        "film thickness",
        "its factor for a meniscus one half width ahead",
        0.821192401315268,
        "",
        D_BRAIN,
        starvation_of_the_ball,
        tolerance=1e-5,
        beside=True,
    ),
    Anchor(
        "film thickness",
        "the starved film",
        1.09573218705714,
        "um",
        D_BRAIN,
        lambda: 1e6 * ball_on_inner_ring()[0] * starvation_of_the_ball(),
        tolerance=1e-5,
        beside=True,
    ),
    Anchor(
        "film thickness",
        "minimum film of Hamrock and Dowson",
        1.07933,
        "um",
        D_BRAIN,
        lambda: 1e6 * point_film_minimum(100.0, 10.0, 20e-3, 30e-3, 200e9, 40e-3, 2e-8),
        tolerance=1e-5,
        beside=True,
    ),
    Anchor(
        "film thickness",
        "starvation of a minimum film",
        0.784506626,
        "",
        D_BRAIN,
        lambda: starvation_minimum(6e-4 * 2e-3, 2e-3, 6e-5, 6e-5),
        tolerance=1e-6,
        beside=True,
    ),
    Anchor(
        "inlet heating",
        "inlet heating after Murch and Wilson",
        0.938371825085712,
        "",
        D_BRAIN,
        lambda: thermal_factor(thermal_loading(43.691e-3, 7.5e-4, 22.36094193, 0.145), "murch_wilson"),
        tolerance=1e-6,
    ),
    *(
        Anchor(
            "traction",
            f"traction of Aihara at {pressure:.0f} kgf/mm2",
            expected,
            "",
            D_BRAIN,
            partial(aihara_coefficient, pressure, slip, speed),
            tolerance=1e-5,
        )
        for pressure, slip, speed, expected in AIHARA
    ),
)
