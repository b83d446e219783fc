"""Torque by source under a static load, and the slip of the raceways that drive the rollers."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import plain
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.choice.load_cases import LoadCase
from beardyn_core.effects import LineFilm, Rib, Traction
from beardyn_core.physics.bodies.layout import CONE
from beardyn_core.physics.cage.drag import cage_drag_torque
from beardyn_core.physics.cage.rubbing import bar_weight
from beardyn_core.physics.drag import drag_params, drag_push, drag_torque
from beardyn_core.physics.flanges import flange_params
from beardyn_core.physics.lamina_table import lamina_table
from beardyn_core.physics.pure_rolling import kinematic_params
from beardyn_core.physics.rib import large_rib_params
from beardyn_core.physics.rolling_resistance import oil_supply
from beardyn_core.physics.seal import seal_params, seal_torque
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.statics.torque import (
    entrainment_speeds,
    flanges_torque,
    rib_torque,
    running_torque,
)
from beardyn_core.physics.traction import TractionLaws, lamina_friction, rolling_lamina, traction_laws
from beardyn_core.scene.scene import Scene

_DEEP_SLIP = 1.0
_SLIPS = np.concatenate([np.zeros(1), np.geomspace(1.0e-7, _DEEP_SLIP, 400)])
_NEARLY_ALL = 0.5
# Films have their limiting stress at slips of some percent, Johnson and Tevaarwerk (1977), Fig. 4. What
# resists more is the oil around the contacts, which has no limit: from this slip on rollers are said to skid.
LOST_GRIP = 0.25


@dataclass(frozen=True)
class Drive:
    """How raceway traction drives the rollers."""

    needed: A[float, "tangential force over all loaded rollers, [N]"]
    available: A[float, "what traction could give, [N]"]
    slip: A[float, "slip over entrainment speed at which the traction is what is needed; 1 where it never is"]
    torque: A[float, "on the shaft, that the slip loses, [N m]"]

    def share(self, force: float) -> float:
        """Compute a braking force over the force that drives the rollers, at most 1."""
        driving = min(self.needed, self.available)
        return min(abs(force) / driving, 1.0) if driving > 0.0 else 1.0

    @property
    def skids(self) -> bool:
        """Whether so much of the traction is used that lightly loaded rollers may skid."""
        return self.used > _NEARLY_ALL or self.slip > LOST_GRIP

    @property
    def used(self) -> float:
        """Needed over available traction."""
        if self.needed == 0.0:
            return 0.0
        return self.needed / self.available if self.available > 0.0 else math.inf


class Losses:
    """Torque by source of a scene with the reference's effects under one load, in pure rolling.

    ``gravity`` [m/s^2] is that of the idle rollers, which lie on the cage.
    """

    def __init__(
        self, scene: Scene, case: LoadCase, static: StaticSolution, gravity: float = STANDARD_GRAVITY
    ) -> None:
        self.scene, self.case, self.static, self.gravity = scene, case, static, gravity
        self.speed = abs(case.speed)
        bearing = scene.bearing
        self._entrainment = entrainment_speeds(bearing, self.speed)
        self._motion, self._medium = kinematic_params(scene), drag_params(scene)
        self._speeds = self.speed, self._motion.cage_ratio * self.speed
        self.rolling, self._couples = self._roll(scene.effects.film)

    def _roll(self, film: LineFilm | None) -> tuple[float, Float]:
        """Compute torque [N m] and couples [N m] of the rolling resistance with the oil that a film has."""
        effect = self.scene.effects.rolling_resistance
        if effect is None or self.speed == 0.0:
            return 0.0, np.zeros((2, *self.static.cup_load.shape))
        running = running_torque(
            self.scene.bearing,
            self.scene.lubricant,
            self.scene.temperature,
            self.static,
            self.speed,
            resistance=effect,
            supply=oil_supply(film),
        )
        return running.rolling, np.stack([running.cup_couple, running.cone_couple])

    def rolling_with(self, film: LineFilm | None) -> float:
        """Compute the torque of the rolling resistance with another film, whose oil feeds it, [N m]."""
        return self._roll(film)[0]

    @property
    def drag(self) -> float:
        """Torque of drag and churning, [N m]."""
        return float(plain(drag_torque)(self._speeds, self._motion, self._medium))

    @property
    def _push(self) -> float:
        """Force of the medium on the orbit of a roller, [N]."""
        return float(plain(drag_push)(self._speeds, self._motion, self._medium))

    @property
    def seal(self) -> float:
        """Torque of both seals, [N m]."""
        return float(plain(seal_torque)(self.speed, seal_params(self.scene)))

    @property
    def cage_drag(self) -> dict[str, float]:
        """Torques of the effects that brake the cages, by source of loss, [N m]."""
        return cage_drag_torque(self.scene, self.speed)

    def rib(self, rib: Rib | None) -> float:
        """Compute the torque of the sliding ribs with some options, [N m]."""
        scene = self.scene
        law = large_rib_params(scene.bearing, rib, scene.lubricant, scene.temperature)
        ribs = flange_params(scene.mounted_bearing, rib, scene.lubricant, scene.temperature)
        of_one = rib_torque(scene.bearing, self.static, self.speed, law)
        return of_one + flanges_torque(self.static, self.speed, ribs)

    @property
    def pocket(self) -> float:
        """Torque of the pockets, [N m]: the cage pushes idle rollers, loaded ones push the cage."""
        pocket = self._motion.pocket  # a kinematic cage has none that rub
        if pocket is None or self.speed == 0.0:
            return 0.0
        return 0.5 * pocket.lever * self.pocket_force

    @property
    def pocket_force(self) -> float:
        """Normal forces of all pockets, [N]."""
        idle = self.scene.roller_total - int(np.count_nonzero(self.static.cone_load > 0.0))
        return 2.0 * idle * (self._push + bar_weight(self.scene.bearing, self.gravity))

    @property
    def total(self) -> float:
        """Of all sources of the reference, [N m]."""
        effects = self.scene.effects
        drive = self.drive(effects.traction, effects.film)
        # what the traction does not drive does not roll
        rolling = self.rolling / max(drive.used, 1.0) if math.isfinite(drive.used) else 0.0
        total = rolling + self.drag + self.seal + self.rib(effects.rib) + self.pocket + drive.torque
        return total + sum(self.cage_drag.values())

    def film_parameter(self, film: LineFilm | None) -> float:
        """Compute film over roughness at the cone for the most loaded roller, [-]; 0 without a film."""
        load = float(self.static.cone_load.max())
        if film is None or self.speed == 0.0 or load <= 0.0:
            return 0.0
        laws, laminae = self._laws(None, film)
        contact = rolling_lamina(load, self._entrainment[1], 0.0, CONE, laws, laminae)
        return float(np.exp2(contact.log2_film)) / self.scene.bearing.raceway_roughness

    def _laws(self, traction: Traction | None, film: LineFilm | None) -> tuple[TractionLaws, Float]:
        """Take other friction and another film, of contacts in one lamina."""
        scene = self.scene
        effects = replace(scene.effects, traction=traction, film=film)
        whole = replace(scene, effects=effects, numerics=replace(scene.numerics, laminae=1))
        return traction_laws(whole), lamina_table(whole)

    def drive(
        self, traction: Traction | None, film: LineFilm | None, *, rolling: bool = True, drag: bool = True
    ) -> Drive:
        """Compute the traction that the rollers need and what the law of friction gives."""
        loaded = self.static.cone_load > 0.0
        if self.speed == 0.0 or not loaded.any():
            return Drive(0.0, 0.0, 0.0, 0.0)
        needed = 0.0
        if rolling:
            needed += float(self._couples[:, loaded].sum()) / self.scene.bearing.roller_diameter
        if drag:
            needed += self.scene.roller_total * self._push
        needed += 0.5 * self.pocket_force
        loads = np.minimum(self.static.cone_load, self.static.cup_load)[loaded]
        available, slip = self._slip(traction, film, loads, needed)
        torque = 2.0 * min(needed, available) * slip * self._entrainment[1] / self.speed
        return Drive(needed, available, slip, torque)

    def _slip(
        self, traction: Traction | None, film: LineFilm | None, loads: Float, needed: float
    ) -> tuple[float, float]:
        """Compute the available traction [N] and the slip over entrainment speed at the needed traction."""
        if traction is None:
            return 0.0, _DEEP_SLIP
        speed, (laws, laminae) = self._entrainment[1], self._laws(traction, film)
        contact = rolling_lamina(loads[:, None], speed, _SLIPS * speed, CONE, laws, laminae)
        force = (lamina_friction(contact, laws) * _SLIPS * speed).sum(axis=0)
        available = float(force.max())
        if needed >= available:
            return available, _DEEP_SLIP
        return available, float(np.interp(needed, np.maximum.accumulate(force), _SLIPS))
