"""From nouns to kernel parameters."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beardyn_core.bearing.contact_law import LINE_EXPONENT
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import LoadSharingTraction
from beardyn_core.physics.barrel_line import BarrelParams, barrel_params
from beardyn_core.physics.bodies.arrangement import Arrangement, aligned_zeros
from beardyn_core.physics.bodies.layout import (
    HELD_COEFFICIENT,
    LAMINA_STIFFNESS,
    MASK,
    OVERSIZE,
    POCKET_ANGLE,
    ROLLER_CONSTANTS,
)
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.bodies.step_stages import new_timers
from beardyn_core.physics.cage.drag import cage_drag_params
from beardyn_core.physics.cage.parameters import cage_params
from beardyn_core.physics.contact_damping import damping_params
from beardyn_core.physics.defect import fault_params, roller_oversize
from beardyn_core.physics.drag import drag_params
from beardyn_core.physics.film import film_params
from beardyn_core.physics.flanges import flange_params
from beardyn_core.physics.journal import journal_params
from beardyn_core.physics.lamina_coupling import coupling_params
from beardyn_core.physics.lamina_table import lamina_table
from beardyn_core.physics.modal_body import body_of
from beardyn_core.physics.rib import large_rib_params
from beardyn_core.physics.ring_modes import structure_params
from beardyn_core.physics.rolling_resistance import oil_supply, rolling_params
from beardyn_core.physics.scatter import pocket_offsets
from beardyn_core.physics.seal import seal_params
from beardyn_core.physics.small_rib import small_rib_params
from beardyn_core.physics.suspension import mounting_params
from beardyn_core.physics.tiers.parameters import (
    AuditParams,
    EffectParams,
    ExplicitParams,
    GravityParams,
    HeldParams,
    Parameters,
    RacewayParams,
    RollerParams,
)
from beardyn_core.physics.traction import traction_params
from beardyn_core.scene.scene import Scene

# waveform samples from one time that friction of the raceways is worked out to the next: 78 us, whatever the
# step, see `bodies.friction_substeps`
HELD_SAMPLES = 2.0
LEAST_SHARE, MOST_SHARE = 1.0 / 12.0, 0.25
_PRESSURE = 4e9  # the static rating's limit of roller bearings, ISO 76 [Pa]
_MARGIN = 1.1  # on the frequency, for ribs and moving rings


def highest_bounce(bearing: RollerBearing, stiffness: float) -> float:
    """Work out the rate at which a roller bounces between its raceways under the highest pressure, [rad/s].

    ``stiffness``: factor of one raceway contact, all laminae together [N/m^(10/9)], of barrels [N/m].

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, eq. 4.45: p^2 = Q E' / (2 pi L R), here with the roller's own
    radius as R, and with 4 GPa, at which ISO 76 rates roller bearings statically.
    """
    if bearing.self_aligning:  # slices of barrels are as stiff at any load
        return math.sqrt(2.0 * stiffness / bearing.roller_mass)
    radius, length = 0.5 * bearing.roller_diameter, bearing.effective_length
    load = 2.0 * math.pi * length * radius * _PRESSURE**2 / bearing.material.contact_modulus
    one = LINE_EXPONENT * stiffness ** (1.0 / LINE_EXPONENT) * load ** (1.0 - 1.0 / LINE_EXPONENT)
    return math.sqrt(2.0 * one / bearing.roller_mass)


def spring_time(bearing: RollerBearing, laminae: NDArray[np.float64], step: float, damped: bool) -> float:
    """Compute the share of the step over which contact springs are implicit, from the lamina table, [s].

    ``laminae`` [LAMINA_ROWS, lamina]; ``step``: [s]; ``damped``: whether contacts are damped. A share between
    1/12 and 1/4 is stable for a linear mode. Contacts that lift off without a damper make energy with it,
    until the rollers fly apart; with 1/4 they do not.
    """
    if not damped:
        return MOST_SHARE * step
    bounce = highest_bounce(bearing, float(laminae[LAMINA_STIFFNESS].sum()))
    return step * implicit_spring_share(bounce, step)


def implicit_spring_share(bounce: float, step: float) -> float:
    """Choose Newmark's beta: the least that is stable, and 1/12 where the step resolves the bounce.

    ``bounce``: highest rate of a mode of rollers on their contacts [rad/s]; ``step``: [s]. From 1/12
    to 1/4.

    With velocities half a step after positions the frequency w of an undamped mode comes out as w' with
    4 sin^2(w' h / 2) = (w h)^2 (1 - 4 beta sin^2(w' h / 2)): stable up to (w h)^2 (1 - 4 beta) = 4, and for
    beta = 1/12 right to the fourth order in the step, for anything else to the second.

    References
    ----------
    Newmark, N. M. (1959), A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85(3);
    Hairer, E., Lubich, C. and Wanner, G. (2003), Acta Numerica 12, 399-450, for the staggered form.
    """
    return max(LEAST_SHARE, MOST_SHARE - 1.0 / (_MARGIN * bounce * step) ** 2)


def raceway_params(
    angle: float, radius: float, side: float, gap: float, barrel: BarrelParams | None = None
) -> RacewayParams:
    """Describe a raceway by its angle [rad], and its radius at the axial place from which it is measured [m].

    ``side``: +1 of the cup, -1 of the cone; ``gap``: along its normal from the nominal roller [m];
    ``barrel``: arcs of spherical roller bearings.
    """
    cosine = math.cos(angle)
    return RacewayParams(math.sin(angle), cosine, side, gap + side * cosine * radius, barrel)


def roller_constants(
    arrangement: Arrangement, oversize: NDArray[np.float64], ahead: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Collect constants of each roller, [block, ROLLER_CONSTANTS, lane].

    ``oversize``: radius error [m]; ``ahead``: of the pocket [rad]; both [row, roller].
    """
    constants = aligned_zeros(arrangement.block_count, ROLLER_CONSTANTS, arrangement.width)
    constants[:, MASK] = arrangement.mask
    constants[:, POCKET_ANGLE] = 2.0 * math.pi * arrangement.roller / arrangement.roller_count
    constants[:, POCKET_ANGLE] += arrangement.to_lanes(ahead)
    constants[:, OVERSIZE] = arrangement.to_lanes(oversize)
    return constants


def held_params(scene: Scene, arrangement: Arrangement) -> HeldParams | None:
    """Make the memory of friction, or ``None`` where it is cheap or the step is explicit."""
    dear = isinstance(scene.effects.traction, LoadSharingTraction)
    if not dear or scene.numerics.integrator == "explicit":
        return None
    fields = HELD_COEFFICIENT + scene.numerics.laminae
    steps = max(1.0, HELD_SAMPLES * scene.numerics.steps_per_sample)
    return HeldParams(steps, aligned_zeros(2 * arrangement.block_count, fields, arrangement.width))


def build_parameters(
    scene: Scene, arrangement: Arrangement, preload: NDArray[np.float64], rest: ArrayLike = (0.0,) * 6
) -> Parameters:
    """Build the kernel parameters of a scene.

    Parameters
    ----------
    preload : float64 array, shape [6]
        Force and moment of the suspension on the axlebox at rest, [N, N m].
    rest : array_like, shape [6], optional
        The same of the rollers on the cone.
    """
    bearing, effects, damping = scene.bearing, scene.effects, scene.effects.contact_damping
    offset = bearing.roller_mass_offset
    taper = math.tan(bearing.half_angle)
    coulomb, mixed, load_sharing = traction_params(scene)
    laminae, count = lamina_table(scene), scene.numerics.laminae
    step = 1.0 / (WAVEFORM_RATE * scene.numerics.steps_per_sample)
    body = body_of(scene)
    return Parameters(
        step=step,
        spring_time=spring_time(bearing, laminae, step, damping is not None and damping.time_constant > 0.0),
        roller=RollerParams(
            mass=bearing.roller_mass,
            axial_inertia=bearing.roller_axial_inertia,
            transverse_inertia=bearing.roller_transverse_inertia,
            radius=float(bearing.radius_at(np.asarray(offset))),
            taper=taper,
            apex=bearing.cup_line[1],
            half_length=0.5 * bearing.roller_length,
            mass_offset=offset,
        ),
        cup=raceway_params(
            bearing.cup_slant,
            bearing.cup_line[0],
            1.0,
            bearing.normal_gap(scene.end_play),
            barrel_params(bearing, "cup", count),
        ),
        cone=raceway_params(
            bearing.cone_slant, bearing.cone_line[0], -1.0, 0.0, barrel_params(bearing, "cone", count)
        ),
        laminae=laminae,
        lamina_loads=aligned_zeros(1, 2 * laminae.shape[1], arrangement.width),
        rollers=roller_constants(arrangement, roller_oversize(scene), pocket_offsets(scene)),
        mounting=mounting_params(
            bearing,
            scene.mounting,
            preload,
            body.modes if body else None,
            journal_params(scene, step, rest),
        ),
        effects=EffectParams(
            damping=damping_params(scene),
            film=film_params(scene),
            coupling=coupling_params(bearing, effects.lamina_coupling, scene.numerics.laminae, arrangement),
            coulomb=coulomb,
            mixed=mixed,
            rolling=rolling_params(
                bearing,
                effects.rolling_resistance,
                scene.lubricant,
                scene.temperature,
                oil_supply(effects.film),
            ),
            drag=drag_params(scene),
            seal=seal_params(scene),
            cage_drag=cage_drag_params(scene),
            cage=cage_params(scene, step),
            rib=large_rib_params(bearing, effects.rib, scene.lubricant, scene.temperature),
            flanges=flange_params(scene.mounted_bearing, effects.rib, scene.lubricant, scene.temperature),
            small_rib=small_rib_params(bearing, effects),
            load_sharing=load_sharing,
            structure=structure_params(body, scene, arrangement, step),
            gravity=GravityParams(effects.gravity.acceleration) if effects.gravity else None,
            faults=fault_params(scene, arrangement, laminae),
            audit=AuditParams(1.0) if effects.audit else None,
            timers=new_timers(),
        ),
        explicit=(ExplicitParams(1.0) if scene.numerics.integrator == "explicit" else None),
        held=held_params(scene, arrangement),
    )
