"""The twin's own kernel with a step far beyond what a scene may ask for: it has to say so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import PENETRATION, SIGNAL_CHANNELS
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.tiers.build import build_parameters, spring_time
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.physics.tiers.start import initial_state
from beardyn_core.physics.tiers.state import Output, work_space
from beardyn_core.physics.tiers.status import Status, assess, chatter_index
from beardyn_core.scene.scene import Scene
from evidence.hard.case import Point
from evidence.hard.watch import Measures

STEPS = 500


def coarse_run(scene: Scene, point: Point, factor: float) -> Measures:
    """Make 500 steps under one load with the scene's step times `factor`.

    Of a run that is not finite at its end nothing is measured: its largest penetration is that of a roller
    on its way to infinity.
    """
    bearing, arrangement = scene.bearing, Arrangement(scene.bearing.roller_count, LANE_WIDTH)
    parameters = build_parameters(scene, arrangement, np.zeros(6))
    step = parameters.step * factor
    damped = scene.effects.contact_damping is not None
    parameters = parameters._replace(
        step=step, spring_time=spring_time(bearing, parameters.laminae, step, damped)
    )
    static = solve(
        bearing, point.force, end_play=scene.end_play, laminae=scene.numerics.laminae, speed=point.speed
    )
    orbit = cage_speed(bearing, point.speed)
    state = initial_state(bearing, arrangement, parameters, static, point.speed, orbit)
    work = work_space(arrangement)
    signals = np.zeros((STEPS, SIGNAL_CHANNELS))
    load = np.array([*point.force, *point.moment, point.speed, 0.0, 0.0, 0.0])
    trends = np.empty((1, *state.rollers.shape)), np.empty((1, *state.bodies.shape))
    output = Output(signals, *trends, np.zeros(ENERGY_TERMS))
    advance(Lanes(LANE_WIDTH), state, work, np.repeat(load[None], STEPS + 1, axis=0), output, parameters)
    status = assess(state, STEPS, bearing.large_end_radius, parameters.effects.rib)
    made = Measures(STEPS * parameters.step, int(status), bool(np.isfinite(signals).all()))
    if status & Status.NOT_FINITE:
        return made
    return replace(
        made,
        penetration=float(state.rollers[:, PENETRATION].max()),
        chatter_index=float(chatter_index(state, STEPS).max()),
        mean_force=float(np.linalg.norm(signals[STEPS // 2 :, :3].mean(axis=0))),
        peak_force=float(np.linalg.norm(signals[:, :3], axis=1).max()),
    )
