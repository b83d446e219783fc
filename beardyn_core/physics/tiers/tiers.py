"""What each tier computes with: its kernel, its parameters and its start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import CONE_BODY, POSITION, TILT
from beardyn_core.physics.cage.play import loose_params
from beardyn_core.physics.pure_rolling import kinematic_params
from beardyn_core.physics.roller_spring import lever_of_cup, roller_tangent
from beardyn_core.physics.rolling_waves import highest_points, highest_wave, rolling_wave_params
from beardyn_core.physics.statics.roller_equilibrium import spring_params
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.suspension import tilt_restraint
from beardyn_core.physics.tiers import tier_parameters
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.physics.tiers.lumped import SpringTrend, advance_lumped, trend_shape
from beardyn_core.physics.tiers.massless_flanges import thrust_params
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.quasistatic import advance_quasistatic
from beardyn_core.physics.tiers.sliding import along_both, slide_params
from beardyn_core.physics.tiers.start import initial_state, settle_lumped
from beardyn_core.physics.tiers.state import State
from beardyn_core.physics.tiers.tier_bending import bending_params, step_body
from beardyn_core.scene.defect import every_patch
from beardyn_core.scene.scene import Scene


@dataclass(frozen=True)
class Tier:
    """How a tier turns loads into states.

    All tiers share the arrays of the full one (`bodies.layout`), so that whatever reads a state or a block
    works with any of them; what a tier does not compute stays zero.
    """

    # Compiled; advances all states over a block of steps. Arguments as of `imex.advance`
    advance: Callable[..., None]
    # Kernel parameters from the scene and the parameters of the full tier
    parameters: Callable[[Scene, Parameters], Any]
    # State at t = 0 from the scene, the arrangement, the kernel parameters, the static equilibrium and the
    # first load (wrench and shaft speed)
    start: Callable[[Scene, Arrangement, Any, StaticSolution, Float], State]
    # Shape of what the kernel keeps of the rollers at an instant, from that of their state
    trend_shape: Callable[[tuple[int, ...], Any], tuple[int, ...]] = lambda shape, _parameters: shape
    # Rollers at the instants from lanes, what the kernel kept, and kernel parameters
    shown: Callable[[Any, Float, Any], Any] = lambda _lanes, trend, _parameters: trend


def spring_laminae(scene: Scene) -> int:
    """Choose the laminae that the springs of the lumped tier stand for: enough for the usual profile."""
    return max(scene.numerics.laminae, scene.bearing.usual_laminae)


def lumped_parameters(scene: Scene, base: Parameters) -> tier_parameters.LumpedParameters:
    """Build the kernel parameters of the lumped tier."""
    floating = base.effects.flanges is not None or scene.bearing.self_aligning
    base = tier_parameters.flatten_profiles(base, scene)
    # springs are measured from their own raceway
    base = base._replace(cup=base.cup._replace(gap=scene.bearing.normal_gap(scene.end_play)))
    motion, spring = (
        tier_parameters.ring_motion_params(base),
        spring_params(scene.bearing, spring_laminae(scene)),
    )
    response = tier_parameters.ring_response_params(base, motion, spring.lever)
    sides = tier_parameters.row_sides(base, scene.rows)
    return tier_parameters.LumpedParameters(
        step=base.step,
        base=tier_parameters.without_surfaces(tier_parameters.without_roller_dynamics(base)),
        kinematic=kinematic_params(scene),
        motion=motion,
        response=response,
        spring=spring,
        pockets=tier_parameters.pocket_directions(base),
        sides=sides,
        faults=tier_parameters.patches_or_none(base.effects.faults),
        waves=rolling_wave_params(base.effects.faults, base.rollers, spring.cone_share),
        highest=highest_points(base.effects.faults, every_patch(scene.defects, scene.bearing)),
        bending=bending_params(scene, base, response.give, response.lever, sides),
        slide=along_both(slide_params(scene)) if floating else slide_params(scene),
        thrust=thrust_params(scene.mounted_bearing, spring_laminae(scene)) if base.effects.flanges else None,
    )


def quasistatic_parameters(scene: Scene, base: Parameters) -> tier_parameters.QuasistaticParameters:
    """Build the kernel parameters of the quasistatic tier."""
    floating = base.effects.flanges is not None or scene.bearing.self_aligning
    motion = tier_parameters.ring_motion_params(base)
    lever, sides = (
        lever_of_cup(scene.bearing),
        tier_parameters.row_sides(base, scene.rows),
    )
    response = tier_parameters.ring_response_params(base, motion, lever)
    return tier_parameters.QuasistaticParameters(
        step=base.step,
        base=tier_parameters.without_roller_dynamics(base),
        kinematic=kinematic_params(scene),
        motion=motion,
        response=response,
        tangent=roller_tangent(scene.bearing),
        pockets=tier_parameters.pocket_directions(base),
        sides=sides,
        highest_wave=highest_wave(base.effects.faults),
        bending=bending_params(scene, base, response.give, response.lever, sides),
        loose=loose_params(scene, base.step),
        slide=None if floating else slide_params(scene),
        grip=slide_params(scene) if floating else None,
        direct=tier_parameters.DirectParams(1.0) if floating else None,
    )


def _start_full(
    scene: Scene, arrangement: Arrangement, parameters: Any, static: StaticSolution, load: Float
) -> State:
    ratio = scene.effects.cage.initial_speed_ratio if scene.effects.cage else 1.0
    orbit = ratio * cage_speed(scene.bearing, load[6])
    return initial_state(scene.bearing, arrangement, parameters, static, load[6], orbit)


def _start_rolling(
    scene: Scene, arrangement: Arrangement, parameters: Any, static: StaticSolution, load: Float
) -> State:
    orbit = cage_speed(scene.bearing, load[6])
    state = initial_state(scene.bearing, arrangement, parameters.base, static, load[6], orbit)
    fitted = step_body(scene, parameters.step)
    flex = np.zeros((2, 0 if fitted is None else len(fitted.share)))
    if fitted is not None:
        flex[0] = fitted.share @ static.bending
    return state._replace(flex=flex)


def _start_lumped(
    scene: Scene, arrangement: Arrangement, parameters: Any, static: StaticSolution, load: Float
) -> State:
    state = _start_rolling(scene, arrangement, parameters, static, load)
    free = scene.mounting.journal_tilt == "free" or scene.mounting.cup == "suspended"
    carried = np.array([load[0], load[1], load[2] - parameters.kinematic.rolling_weight, load[3], load[5]])
    bent, modal_load, fitted = state.flex[0], np.zeros(0), step_body(scene, parameters.step)
    box = parameters.base.mounting.coupling
    if fitted is not None:
        modal_load = np.zeros(len(bent))
        if fitted.body.suspension is not None:
            seats = fitted.body.suspension
            modal_load += (parameters.base.mounting.preload - box.stiffness @ (seats @ bent)) @ seats
    pose, state.flex[0] = settle_lumped(
        scene.bearing,
        parameters,
        np.array([*static.displacement, *static.tilt]),
        bent,
        carried if free else carried[:3],
        modal_load,
        cage_speed(scene.bearing, load[6]),
        tilt_restraint(scene.mounting, parameters.base.mounting),
    )
    state.bodies[CONE_BODY, POSITION : POSITION + 3] = pose[:3]
    state.bodies[CONE_BODY, [TILT, TILT + 2]] = pose[3:]
    return state


TIERS = {
    "full": Tier(advance, lambda _scene, base: base, _start_full),
    "lumped": Tier(advance_lumped, lumped_parameters, _start_lumped, trend_shape, SpringTrend),
    "quasistatic": Tier(advance_quasistatic, quasistatic_parameters, _start_rolling),
}
