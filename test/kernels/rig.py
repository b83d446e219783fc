"""Drive `advance` directly: any lane width, any number of steps, any change of parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import ROLLER_STATES, SIGNAL_CHANNELS
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.defect import roller_oversize
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.modal_body import body_of
from beardyn_core.physics.scatter import crown_errors
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.start import initial_state
from beardyn_core.physics.tiers.state import Output, State, WorkSpace, work_space
from beardyn_core.scene.scene import Scene
from test.scenes import LOAD_80_KN, SPEED

Float = NDArray[np.float64]


def parameters_of(scene: Scene, width: int = 8) -> Parameters:
    """What the kernels of a scene take, with the cup in its place."""
    return build_parameters(scene, arrangement_of(scene, width), np.zeros(6))


def arrangement_of(scene: Scene, width: int = 8) -> Arrangement:
    """How the rollers of a scene lie in lanes."""
    return Arrangement(scene.bearing.roller_count, width, scene.rows, scene.missing_places)


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
        arrangement = arrangement_of(scene, width)
        parameters = parameters_of(scene, width)
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
