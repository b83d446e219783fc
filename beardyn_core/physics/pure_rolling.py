"""Pure rolling of a bearing: speeds and places of the rollers per shaft speed, and what follows from them."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed_ratio, roller_cone_spin
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.cage.rubbing import PocketParams, pocket_params
from beardyn_core.scene.scene import Scene


class KinematicParams(NamedTuple):
    """Motion of the rollers in pure rolling, and what follows from it, per shaft speed w."""

    cage_ratio: float  # cage speed over w
    spin_ratio: float  # spin of a roller against its orbit frame over cage speed
    centrifugal: float  # force over squared cage speed [kg m]
    gyroscopic: float  # moment about the centre of mass, large end outwards, over squared cage speed [kg m^2]
    radius: float  # nominal centre of mass [m]
    axial: float
    axis_radial: float  # roller axis
    axis_axial: float
    cup_radius: float  # contacts from the bearing axis [m]
    cone_radius: float
    rib_slip: float  # sliding speed of the rib over w [m]
    rib_spin: float  # rotation of a roller against the cone over w
    rolling_on_cup: float  # rotation of a roller against the cup over w, of either sign
    rolling_on_cone: float
    rolling_weight: float  # of all rollers and cages [N]
    rolling_count: float  # rollers of all rows
    pocket: PocketParams | None


def pure_rolling(bearing: RollerBearing) -> KinematicParams:
    """Work out the pure rolling of one roller of a bearing, without weight and without pockets."""
    sine, cosine = math.sin(bearing.roller_slant), math.cos(bearing.roller_slant)
    offset = bearing.roller_mass_offset
    radius = bearing.roller_orbit_radius
    axial_inertia, transverse = bearing.roller_axial_inertia, bearing.roller_transverse_inertia
    cup, roller = bearing.rolling_radii
    spin_ratio = cup / roller
    spin = roller_cone_spin(bearing, 1.0)
    return KinematicParams(
        cage_ratio=cage_speed_ratio(bearing),
        spin_ratio=-spin_ratio,
        centrifugal=bearing.roller_mass * radius,
        gyroscopic=sine * (axial_inertia * spin_ratio - (axial_inertia - transverse) * cosine),
        radius=radius,
        axial=0.5 * bearing.row_spacing + offset * cosine,
        axis_radial=sine,
        axis_axial=cosine,
        cup_radius=bearing.cup_radius,
        cone_radius=bearing.cone_radius,
        rib_slip=spin * bearing.rib_contact_height if isinstance(bearing, Bearing) else 0.0,
        rib_spin=spin,
        rolling_on_cup=bearing.cone_radius / bearing.roller_diameter,
        rolling_on_cone=bearing.cup_radius / bearing.roller_diameter,
        rolling_weight=0.0,
        rolling_count=1.0,
        pocket=None,
    )


def kinematic_params(scene: Scene) -> KinematicParams:
    """Work out the pure rolling of all rollers of a scene."""
    bearing, effects = scene.bearing, scene.effects
    fall = effects.gravity.acceleration if effects.gravity else 0.0
    cages = scene.rows * bearing.cage.mass if effects.cage else 0.0
    return pure_rolling(bearing)._replace(
        rolling_weight=fall * (scene.roller_total * bearing.roller_mass + cages),
        rolling_count=float(scene.roller_total),
        pocket=pocket_params(scene),
    )
