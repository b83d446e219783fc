"""Drive `advance` directly: any lane width, any number of steps, any change of parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice import load_scene
from beardyn_core.effects import EffectSet
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import ENERGY_TERMS, ROLLER_STATES, SIGNAL_CHANNELS
from beardyn_core.physics.defect import roller_oversize
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.ring_modes import body_of
from beardyn_core.physics.scatter import crown_errors
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.start import initial_state
from beardyn_core.physics.tiers.state import Output, State, WorkSpace, work_space
from beardyn_core.scene.defect import Defect
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness
from beardyn_core.twin import Twin

Float = NDArray[np.float64]

SPEED = 122.0
LOAD_80_KN = (0.0, 0.0, 8.0e4)


@cache
def standard_scene() -> Scene:
    """The shipped 80 kN scene: cup held, no play, the effects of `EffectSet()`."""
    return replace(load_scene("static_80kN"), effects=EffectSet())


def scene_with(
    effects: EffectSet | None = None,
    *,
    end_play: float | None = None,
    defects: tuple[Defect, ...] = (),
    waviness: tuple[Waviness, ...] = (),
    laminae: int = 6,
    steps_per_sample: int = 4,
    roller_count: int | None = None,
    **mounting: Any,
) -> Scene:
    """The standard scene with a few things changed."""
    scene = standard_scene()
    bearing = scene.bearing
    if roller_count is not None:
        bearing = replace(bearing, roller_count=roller_count)
    return replace(
        scene,
        bearing=bearing,
        effects=scene.effects if effects is None else effects,
        end_play=scene.end_play if end_play is None else end_play,
        defects=defects,
        waviness=waviness,
        mounting=replace(scene.mounting, **mounting),
        numerics=replace(scene.numerics, laminae=laminae, steps_per_sample=steps_per_sample),
    )


@dataclass
class Rig:
    """A bearing under a constant load, stepped by hand.

    Parameters
    ----------
    scene : Scene
    width : int
        Lanes.
    load : float64 array, shape [10]
        Wrench on the journal, shaft speed, bogie displacement.
    """

    scene: Scene
    arrangement: Arrangement
    parameters: Parameters
    state: State
    work: WorkSpace
    load: Float
    audit: Float

    @staticmethod
    def at_equilibrium(
        scene: Scene,
        force: tuple[float, float, float] = LOAD_80_KN,
        speed: float = SPEED,
        *,
        width: int = 8,
        cage_ratio: float = 1.0,
    ) -> Rig:
        bearing = scene.bearing
        arrangement = Arrangement(bearing.roller_count, width, scene.rows, scene.missing_places)
        parameters = build_parameters(scene, arrangement, np.zeros(6))
        static = solve(
            bearing,
            np.array(force),
            end_play=scene.end_play,
            laminae=scene.numerics.laminae,
            speed=speed,
            coupling=scene.effects.lamina_coupling,
            oversize=roller_oversize(scene),
            crown=crown_errors(scene),
            body=body_of(scene),
            axial_stiffness=scene.mounting.axial_prop_stiffness,
            rows=scene.rows,
            missing=scene.missing_places,
        )
        orbit = cage_ratio * cage_speed(bearing, speed)
        state = initial_state(bearing, arrangement, parameters, static, speed, orbit)
        load = np.array([*force, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0])
        return Rig(
            scene, arrangement, parameters, state,
            work_space(arrangement, parameters.effects.structure), load, np.zeros(ENERGY_TERMS),
        )  # fmt: skip

    def run(
        self, steps: int, trends: int = 1, kernel: Callable[..., None] = advance
    ) -> tuple[Float, Float, Float]:
        """Advance; returns signals [step, channel] and trends of rollers and bodies."""
        structure = self.parameters.effects.structure
        seats = 0 if structure is None else len(structure.seats) - 6
        signals = np.zeros((steps, SIGNAL_CHANNELS + seats))
        rollers = np.zeros((trends, *self.state.rollers.shape))
        bodies = np.zeros((trends, *self.state.bodies.shape))
        loads = np.repeat(self.load[None], steps + 1, axis=0)
        output = Output(signals, rollers, bodies, self.audit)
        kernel(Lanes(self.arrangement.width), self.state, self.work, loads, output, self.parameters)
        return signals, rollers, bodies

    def fields(self) -> Float:
        """Roller fields [field, row, roller]."""
        return self.arrangement.to_rollers(np.moveaxis(self.state.rollers, 1, 0))

    def set_fields(self, fields: Float) -> None:
        """Write roller states [ROLLER_STATES, row, roller]."""
        for field in range(ROLLER_STATES):
            self.state.rollers[:, field] = self.arrangement.to_lanes(fields[field])


def constant_load(
    force: tuple[float, float, float], speed: float, duration: float = 10.0, *moment: float
) -> LoadHistory:
    """One load and one speed."""
    wrench = np.array([*force, *(moment or (0.0, 0.0, 0.0))])
    times = np.array([0, round(duration * 1e9)], dtype=np.int64)
    return LoadHistory(times, np.repeat(wrench[None], 2, axis=0), np.full(2, speed), np.zeros((2, 3)))


def stepped_load(points: list[tuple[float, tuple[float, float, float], float]]) -> LoadHistory:
    """Points of time [s], force on the journal [N] and shaft speed [rad/s], linear in between."""
    times = np.array([round(time * 1e9) for time, _, _ in points], dtype=np.int64)
    wrench = np.array([[*force, 0.0, 0.0, 0.0] for _, force, _ in points])
    return LoadHistory(times, wrench, np.array([s for _, _, s in points]), np.zeros((len(points), 3)))


def started(scene: Scene, load: LoadHistory) -> Twin:
    """A twin at t = 0."""
    twin = Twin(scene)
    twin.start(load)
    return twin
