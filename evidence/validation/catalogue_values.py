"""Kinematics, ratings and lubricants."""

from __future__ import annotations

import math
from functools import partial

from beardyn_core.bearing.kinematics import cage_speed, frequencies
from beardyn_core.bearing.life import dynamic_rating, rating_factor
from beardyn_core.config import load_bearing, load_lubricant
from evidence.validation.anchor import Anchor

CWRU = "CWRU 6205 drive-end bearing: 9 balls, 0.3126 and 1.537 in"
ISO = "ISO 281, table of f_c for radial roller bearings"
RATED = "derived, with the mean angle where ISO 281 takes the cup angle (0.4 to 0.5 %)"


def cwru(index: int) -> float:
    """Return a fault frequency of the 6205 bearing of the CWRU data set, per shaft turn."""
    found = frequencies(9, 1.537, 0.3126, 0.0)
    return (found.bpfo, found.bpfi, found.ftf, 2.0 * found.bsf)[index]


def rating_kN(name: str) -> float:
    """Return the dynamic radial rating of a shipped bearing, [kN]."""
    return dynamic_rating(load_bearing(name)).radial / 1e3


def viscosity(name: str, celsius: int) -> float:
    """Return the kinematic viscosity of a shipped lubricant, [mm^2/s]."""
    return 1e6 * load_lubricant(name).kinematic_viscosity(273.15 + celsius)


VISCOSITIES = (
    ("EP220", 78.8, 35.6),
    ("LGEP2", 68.7, 30.3),
    ("RAIL100", 39.5, 19.3),
    ("FVA3", 37.9, 18.7),
)

ANCHORS = (
    Anchor(
        "cage speed",
        "cage speed at a shaft speed of 122 rad/s",
        52.4,
        "rad/s",
        "Santos 2017: a quarter turn in 0.03 s",
        lambda: cage_speed(load_bearing("HS130x230"), 122.0),
        tolerance=0.005,
    ),
    *(
        Anchor(
            "load rating",
            f"rating factor f_c at gamma {gamma:g}",
            value,
            "",
            ISO,
            partial(rating_factor, gamma),
            tolerance=4e-3,
        )
        for gamma, value in ((0.10, 84.2), (0.14, 87.7), (0.20, 88.7), (0.30, 83.8))
    ),
    *(
        Anchor(
            "load rating",
            f"dynamic load rating of {name}",
            value,
            "kN",
            RATED,
            partial(rating_kN, name),
            tolerance=6e-3,
        )
        for name, value in (("HS130x230", 977.0), ("FR130x230x150", 923.0), ("METRO120x220", 826.0))
    ),
    *(
        Anchor(
            "fault frequency",
            f"{name} per shaft revolution",
            value,
            "",
            CWRU,
            partial(cwru, index),
            absolute=1e-4,
        )
        for index, (name, value) in enumerate(
            (("BPFO", 3.5848), ("BPFI", 5.4152), ("FTF", 0.39828), ("twice BSF", 4.7135))
        )
    ),
    *(
        Anchor(
            "viscosity",
            f"viscosity of {name} at {celsius} deg C",
            value,
            "mm2/s",
            "derived, Walther interpolation",
            partial(viscosity, name, celsius),
            absolute=0.06,
        )
        for name, at_60, at_80 in VISCOSITIES
        for celsius, value in ((60, at_60), (80, at_80))
    ),
    Anchor(
        "viscosity",
        "FVA reference oil 3 at 50 deg C",
        50.0,
        "mPa s",
        "data sheet, from memory",
        lambda: 1e3 * load_lubricant("FVA3").dynamic_viscosity(323.15),
        tolerance=0.05,
    ),
    Anchor(
        "geometry",
        "angle of the cup, HS130x230 closed on its apex",
        12.0,
        "deg",
        "Zhao et al. 2026, Table 2",
        lambda: math.degrees(load_bearing("HS130x230").cup_angle),
        absolute=0.01,
    ),
)
