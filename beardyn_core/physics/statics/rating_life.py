"""Rating life of a bearing under a load history: ISO 281 and ISO 16281, basic and modified."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.life import (
    LIFE_EXPONENT,
    SMALLEST_LAMINA_COUNT,
    basic_rating_life,
    dynamic_rating,
    fatigue_load_limit,
    life_modification,
    reference_life,
    reference_viscosity,
)
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.modal_body import bending_rings
from beardyn_core.physics.statics.static import solve
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene

# ISO 281, normal cleanliness of a greased, sealed bearing above 100 mm pitch diameter: 0.6 to 0.8.
USUAL_CONTAMINATION = 0.6
_RADIAL_CLASSES, _AXIAL_CLASSES = 8, 4
_MILLION = 1.0e6


@dataclass(frozen=True)
class LoadClass:
    """One class of a load history: means on the journal, axlebox frame."""

    share: float  # of all revolutions, 0 to 1
    force: tuple[float, float, float]  # [N]
    moment: tuple[float, float, float]  # [N m]
    speed: float  # of the shaft, magnitude [rad/s]


@dataclass(frozen=True)
class RatingLife:
    """Lives at 90 % reliability, [revolutions]; infinite without load.

    Parameters
    ----------
    equivalent_load : float
        Mean dynamic equivalent load P of ISO 281, [N].
    basic, modified : float
        L_10 and L_10m of ISO 281.
    reference_basic, reference_modified : float
        L_10r and L_10mr of ISO 16281, from the load distribution.
    viscosity_ratio : float
        kappa at the mean speed of the revolutions.
    contamination : float
        e_C.
    classes : int
        Load classes that were solved.
    rings : str
        ``rigid``, as ISO 16281 takes them, or ``elastic``: for the load distribution.
    """

    equivalent_load: float
    basic: float
    modified: float
    reference_basic: float
    reference_modified: float
    viscosity_ratio: float
    contamination: float
    classes: int
    rings: str = "rigid"

    def distance(self, wheel_diameter: float | None) -> float | None:
        """Compute the way of a wheel in the life ``reference_modified``, [m]; ``None`` without a wheel."""
        return None if wheel_diameter is None else math.pi * wheel_diameter * self.reference_modified


def scene_life(
    scene: Scene, load: LoadHistory, contamination: float = USUAL_CONTAMINATION
) -> RatingLife | None:
    """Compute the life under the load history of a scene; ``None`` when the shaft never turns."""
    mounting = scene.mounting
    free = mounting.journal_tilt == "free" or mounting.cup == "suspended"
    return rating_life(
        scene.bearing,
        load_classes(replace(load, wrench=mounting.about_bearing_centre(load.wrench))),
        scene.lubricant,
        scene.temperature,
        end_play=scene.end_play,
        tilt="free" if free else "locked",
        contamination=contamination,
    )


def load_classes(load: LoadHistory) -> tuple[LoadClass, ...]:
    """Sort a load history into classes of radial and axial force, weighted by the revolutions under them.

    Their shares add up to 1; there are none when the shaft never turns.
    """
    turned = np.abs(load.shaft_speed)
    if not turned.any():
        return ()
    force, moment = load.wrench[:, :3], load.wrench[:, 3:]
    radial = _class_of(np.hypot(force[:, 0], force[:, 2]), _RADIAL_CLASSES)
    axial = _class_of(force[:, 1], _AXIAL_CLASSES)
    label = radial * _AXIAL_CLASSES + axial
    classes = []
    for chosen in np.unique(label):
        held = label == chosen
        weight = turned[held]
        if weight.sum() == 0.0:
            continue
        force_x, force_y, force_z = np.average(force[held], axis=0, weights=weight).tolist()
        moment_x, moment_y, moment_z = np.average(moment[held], axis=0, weights=weight).tolist()
        classes.append(
            LoadClass(
                share=float(weight.sum() / turned.sum()),
                force=(force_x, force_y, force_z),
                moment=(moment_x, moment_y, moment_z),
                speed=float(np.average(weight, weights=weight)),
            )
        )
    return tuple(classes)


def rating_life(
    bearing: RollerBearing,
    classes: tuple[LoadClass, ...],
    lubricant: Lubricant,
    temperature: float,
    *,
    end_play: float | None,
    tilt: str,
    contamination: float = USUAL_CONTAMINATION,
    laminae: int = SMALLEST_LAMINA_COUNT,
    rings: str = "rigid",
) -> RatingLife | None:
    """Compute the life under classes of load, their damage added by revolutions (Palmgren and Miner).

    Parameters
    ----------
    temperature : float
        Of lubricant and bearing, [K].
    end_play : float or None
        Total axial travel, [m]; ``None``: that of the bearing.
    tilt : str
        ``locked`` or ``free``, as in the static solution.
    contamination : float
        e_C of ISO 281.
    laminae : int
        Laminae of each contact for the reference life.
    rings : str
        For the reference life: ``rigid``, as the standard defines it, or ``elastic``.

    Returns
    -------
    RatingLife or None
        ``None`` without a class that turns.

    References
    ----------
    ISO 281 (2007); ISO/TS 16281 (2008); Palmgren (1924), Miner (1945).
    """
    if not classes:
        return None
    rating, limit = dynamic_rating(bearing), fatigue_load_limit(bearing)
    viscosity = lubricant.kinematic_viscosity(temperature)
    damage, body = np.zeros(4), bending_rings(bearing, rings)
    for part in classes:
        kappa = viscosity / reference_viscosity(bearing, part.speed)
        equivalent = rating.equivalent_load(math.hypot(part.force[0], part.force[2]), part.force[1])
        basic = basic_rating_life(rating.radial, equivalent)
        factor = life_modification(kappa, contamination, limit / equivalent) if equivalent else 1.0
        static = solve(
            bearing,
            part.force,
            (part.moment[0], 0.0, part.moment[2]) if tilt == "free" else (0.0, 0.0, 0.0),
            end_play=end_play,
            tilt=tilt,
            laminae=laminae,
            speed=part.speed,
            body=body,
        )
        reference = reference_life(
            bearing, static.cup_lamina_load, static.cone_lamina_load, kappa, contamination
        )
        damage += part.share / np.array([basic, factor * basic, reference.basic, reference.modified])
    with np.errstate(divide="ignore"):
        lives = 1.0 / damage
    mean_speed = sum(part.share * part.speed for part in classes)
    return RatingLife(
        equivalent_load=rating.radial * (1.0e6 / float(lives[0])) ** (1.0 / LIFE_EXPONENT),
        basic=float(lives[0]),
        modified=float(lives[1]),
        reference_basic=float(lives[2]),
        reference_modified=float(lives[3]),
        viscosity_ratio=viscosity / reference_viscosity(bearing, mean_speed),
        contamination=contamination,
        classes=len(classes),
        rings=rings,
    )


def _class_of(values: Float, count: int) -> NDArray[np.int64]:
    """Sort values into classes of equal width, by index; one class when all are alike."""
    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-9 * max(abs(low), abs(high), 1.0):
        return np.zeros(len(values), dtype=np.int64)
    return np.minimum(((values - low) / (high - low) * count).astype(np.int64), count - 1)


def _millions(revolutions: float) -> str:
    return f"{revolutions / _MILLION:,.0f}" if math.isfinite(revolutions) else "endless"


def life_sentence(life: RatingLife) -> str:
    """Write the lives in one line."""
    return (
        f"basic {_millions(life.basic)} (ISO 281), {_millions(life.reference_basic)} (ISO 16281); modified "
        f"{_millions(life.modified)}, {_millions(life.reference_modified)} million revolutions"
    )


def life_object(life: RatingLife) -> dict[str, Any]:
    """Give the lives for ``--json``, in revolutions; endless ones become null there."""
    return {
        "equivalent_load_N": life.equivalent_load,
        "L10_rev": life.basic,
        "L10m_rev": life.modified,
        "L10r_rev": life.reference_basic,
        "L10mr_rev": life.reference_modified,
        "viscosity_ratio": life.viscosity_ratio,
        "contamination": life.contamination,
        "load_classes": life.classes,
        "rings": life.rings,
    }


def life_lines(life: RatingLife) -> list[str]:
    """Write the lives as lines of text."""
    return [
        "Rating life, million revolutions at 90 % reliability",
        f"  ISO 281    basic {_millions(life.basic)}, modified {_millions(life.modified)}; "
        f"equivalent load {life.equivalent_load / 1e3:.1f} kN",
        f"  ISO 16281  basic {_millions(life.reference_basic)}, "
        f"modified {_millions(life.reference_modified)}; {life.rings} rings",
        f"  viscosity ratio {life.viscosity_ratio:.2f}, contamination {life.contamination:g}",
    ]
