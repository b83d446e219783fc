"""Steady temperatures of a bearing in its axlebox, without the hours of a run.

Losses depend on the temperatures by viscosity and end play, and temperatures on the losses by the thermal
network; what is sought is where both agree, coming from the cold.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.thermal import PartTemperatures, play_change
from beardyn_core.choice.load_cases import LoadCase, circumstances
from beardyn_core.choice.losses import Losses
from beardyn_core.choice.statics import Statics
from beardyn_core.effects import Thermal
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.physics.slow_thermal import cold_start, film_temperature
from beardyn_core.physics.thermal import (
    BOX_NODE,
    CONE_NODE,
    CUP_NODE,
    NODES,
    ROLLER_NODE,
    heat_shares,
    thermal_network,
)
from beardyn_core.scene.scene import Scene

HOTTEST: A[float, "above which grease, cage and seals fail and nothing settles, [K]"] = 473.15
_ITERATIONS = 200
_CLOSE = 0.01  # [K]
# Where rollers lose the cone, losses jump, and balances within this are all there are.
_JUMP = 1.0  # [K]
_STEP = 0.4


@dataclass(frozen=True)
class SteadyHeat:
    """Where temperatures and losses agree."""

    temperature: A[Float, "shape [node], of `beardyn_core.physics.thermal.NODES`, [K]"]
    ambient: A[float, "[K]"]
    end_play: A[float, "as warm as that, [m]"]
    torque: A[dict[str, float], "on the shaft by source, [N m]"]
    speed: A[float, "of the shaft, [rad/s]"]
    settles: A[bool, "whether it stays below `HOTTEST`; otherwise all is as it passed that"]

    @property
    def power(self) -> float:
        """All that friction loses, [W]."""
        return sum(self.torque.values()) * self.speed

    def rise(self, part: str) -> float:
        """Compute how far a part of `NODES` is above the air, [K]."""
        return float(self.temperature[NODES.index(part)]) - self.ambient

    @property
    def box(self) -> float:
        """Temperature of the axlebox, which detectors and sensors see, [K]."""
        return float(self.temperature[BOX_NODE])


def steady_heat(scene: Scene) -> SteadyHeat:
    """Find the steady temperatures of a scene under its typical load.

    Parameters
    ----------
    scene : Scene
        Options of its effect `thermal`, or the usual ones. End play and temperatures of the scene are those
        as mounted, before it warms.

    Returns
    -------
    SteadyHeat
        When the end play closes and the losses run away, what it is like at 200 °C.

    Raises
    ------
    ValidityError
        The load has no static equilibrium.

    Notes
    -----
    Pockets lose what idle rollers need to be pushed. In a run cages are knocked about and squeeze the films
    of their pockets besides: at 80 kN and 1165 rpm it comes to temperatures 15 % further above the air.
    """
    thermal = scene.effects.thermal or Thermal()
    case = circumstances(scene).typical
    network = thermal_network(
        scene.bearing, thermal, scene.mounting.box_mass, abs(case.speed), scene.roller_total, scene.rows
    )
    start = cold_start(scene).temperature
    temperature, before, share = np.full(len(NODES), thermal.ambient), np.zeros(len(NODES)), _STEP
    for _ in range(_ITERATIONS):
        warm = _warm_scene(scene, thermal, temperature, start)
        torque = torque_by_source(warm, case)
        heat = abs(case.speed) * np.array([torque.get(name, 0.0) for name in LOSS_NAMES]) @ heat_shares()
        step = network.steady(heat, thermal.ambient) - temperature
        settles = bool(temperature.max() < HOTTEST)
        if float(step @ before) < 0.0:
            share *= 0.5
        left = float(np.abs(step).max())
        if not settles or left < _CLOSE or (left < _JUMP and share * left < 0.1 * _CLOSE):
            return SteadyHeat(temperature, thermal.ambient, warm.end_play, torque, abs(case.speed), settles)
        temperature, before = temperature + share * step, step
    raise ValidityError(f"{scene.name}: the temperatures still change by {left:.2g} K; none is steady")


def torque_by_source(scene: Scene, case: LoadCase) -> dict[str, float]:
    """Work out the torque on the shaft by source of loss, at the temperature and end play of a scene, [N m].

    The rollers are pressed outwards by their orbit, and the cup bends where the scene lets it.
    """
    statics = Statics(scene)
    static = statics.at(case, bending=statics.flexible)
    if static is None:
        raise ValidityError(f"{scene.name}: the load has no static equilibrium")
    losses, effects = Losses(scene, case, static), scene.effects
    drive = losses.drive(effects.traction, effects.film)
    return {
        "rolling_resistance": losses.rolling,
        "rib": losses.rib(effects.rib),
        "drag": losses.drag,
        "seal": losses.seal,
        "pocket": losses.pocket,
        "raceway_sliding": drive.torque,
        **losses.cage_drag,
    }


def _warm_scene(scene: Scene, thermal: Thermal, temperature: Float, start: Float) -> Scene:
    """Give the scene the film temperature and play that go with some temperatures."""
    change = temperature - start
    closed = play_change(
        scene.bearing,
        PartTemperatures(change[CUP_NODE], change[CONE_NODE], change[ROLLER_NODE]),
        thermal.expansion,
    )
    film = scene.temperature + film_temperature(temperature) - film_temperature(start)
    return replace(scene.with_play(scene.play + closed), temperature=film)
