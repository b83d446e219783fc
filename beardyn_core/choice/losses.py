"""Torque by source under a static load, and the slip of the raceways that drive the rollers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import plain
from beardyn_core.bearing.aihara_range import NO_LONGER_FITTED
from beardyn_core.bearing.film_thickness import line_film, thermal_factor, thermal_loading
from beardyn_core.bearing.oil_layer import layer_thickness, starved_film
from beardyn_core.choice.load_cases import LoadCase
from beardyn_core.effects import (
    CoulombTraction,
    LineFilm,
    LoadSharingTraction,
    MixedTraction,
    Rib,
    ShearedFilmTraction,
    Traction,
)
from beardyn_core.physics.cage_drag import cage_drag_torque
from beardyn_core.physics.drag import drag_params, drag_push, drag_torque
from beardyn_core.physics.lamina_table import equivalent_radius
from beardyn_core.physics.pure_rolling import bar_weight, kinematic_params
from beardyn_core.physics.rib import rib_params
from beardyn_core.physics.rolling_resistance import oil_supply
from beardyn_core.physics.seal import seal_params, seal_torque
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.statics.torque import (
    asperity_load,
    entrainment_speeds,
    rib_torque,
    running_torque,
)
from beardyn_core.scene.scene import Scene

_STANDARD_GRAVITY = 9.80665
_DEEP_SLIP = 1.0
_NEARLY_ALL = 0.5
_THICKEST = 30.0 * math.log(2.0)


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
        return self.used > _NEARLY_ALL

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
        self, scene: Scene, case: LoadCase, static: StaticSolution, gravity: float = _STANDARD_GRAVITY
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
        lubricated = effect.kind != "hysteresis"
        running = running_torque(
            self.scene.bearing,
            self.scene.lubricant,
            self.scene.temperature,
            self.static,
            self.speed,
            form=effect.kind if lubricated else "aihara",
            thermal=effect.thermal,
            hysteresis=effect.hysteresis,
            supply=oil_supply(film),
        )
        share = effect.supply if lubricated else 0.0
        return share * running.rolling, share * np.stack([running.cup_couple, running.cone_couple])

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
        law = rib_params(scene.bearing, rib, scene.lubricant, scene.temperature)
        return rib_torque(scene.bearing, self.static, self.speed, law)

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
        return self._film(film, load) / self.scene.bearing.raceway_roughness

    def _film(self, film: LineFilm, load: float) -> float:
        """Compute the film at the cone under a roller load, [m]."""
        scene, oil = self.scene, self.scene.lubricant
        viscosity = oil.dynamic_viscosity(scene.temperature)
        thickness = line_film(
            load / scene.bearing.effective_length,
            self._entrainment[1],
            float(equivalent_radius(scene.bearing, np.zeros(1), "cone")[0]),
            scene.bearing.material.contact_modulus,
            viscosity,
            oil.pressure_viscosity_at(scene.temperature),
            film.formula,
        )
        factor = 1.0
        if film.thermal != "none":
            loading = thermal_loading(
                viscosity, oil.temperature_coefficient, self._entrainment[1], oil.thermal_conductivity
            )
            factor = thermal_factor(loading, film.thermal)
        found = film.constant_share * factor * thickness
        if film.oil_layer is not None:
            found = starved_film(found, layer_thickness(film.oil_layer, viscosity, self._entrainment[1]))
        return found

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
        speed, total = self._entrainment[1], float(loads.sum())
        if traction is None:
            return 0.0, _DEEP_SLIP
        if isinstance(traction, LoadSharingTraction):
            return self._share_traction(traction, film, loads, needed)
        if isinstance(traction, CoulombTraction) or film is None:
            friction = (
                traction.friction if isinstance(traction, CoulombTraction) else traction.boundary_friction
            )
        else:
            friction = self._blend_friction(traction, film)
        available = friction * total
        if needed >= available:
            return available, _DEEP_SLIP
        used = needed / available
        slip = traction.regularisation_speed * used / math.sqrt(1.0 - used**2) / speed
        return available, min(slip, _DEEP_SLIP)

    def _blend_friction(self, traction: MixedTraction | ShearedFilmTraction, film: LineFilm) -> float:
        """Blend boundary and full-film coefficients by the sixth power of the film parameter."""
        boundary = traction.boundary_friction
        full = traction.full_film_friction if isinstance(traction, MixedTraction) else traction.limiting_shear
        low, high = traction.boundary_film_parameter, traction.full_film_parameter
        place = (self.film_parameter(film) - low) / max(high - low, 1.0e-9)
        return float(full + (boundary - full) * (1.0 - min(max(place, 0.0), 1.0)) ** 6)

    def _share_traction(
        self, law: LoadSharingTraction, film: LineFilm | None, loads: Float, needed: float
    ) -> tuple[float, float]:
        """Compute the sum of asperity and film friction over the rollers, solved for the slip."""
        slips = np.geomspace(1.0e-7, _DEEP_SLIP, 400)
        force = self._shared_force(law, film, loads, slips)
        available = float(force.max())
        if needed >= available:
            return available, _DEEP_SLIP
        return available, float(np.interp(needed, np.maximum.accumulate(force), slips))

    def _shared_force(
        self, law: LoadSharingTraction, film: LineFilm | None, loads: Float, slips: Float
    ) -> Float:
        """Compute the friction of all rollers over the slip, [N]."""
        parameter = self.film_parameter(film)
        asperities = asperity_load(parameter)
        dry = law.boundary_friction * 2.0 / math.pi * np.arctan(law.boundary_slope * slips)
        force = np.zeros_like(slips)
        for load in loads:
            wet = dry if film is None else np.minimum(self._film_friction(law, film, float(load), slips), dry)
            force += load * (wet + (dry - wet) * asperities)
        return force

    def _film_friction(self, law: LoadSharingTraction, film: LineFilm, load: float, slips: Float) -> Float:
        """Compute the traction coefficient of the film over the slip.

        References
        ----------
        Aihara (1987), below the pressures of his tests Bair and Winer (1979), as in the kernels. Eyring's
        ends near three times its stress.
        """
        scene, speed = self.scene, self._entrainment[1]
        radius = float(equivalent_radius(scene.bearing, np.zeros(1), "cone")[0])
        modulus = scene.bearing.material.contact_modulus
        pressure = math.sqrt(load / scene.bearing.effective_length * modulus / (2.0 * math.pi * radius))
        if law.film_traction == "eyring":
            return 3.0 * law.eyring_stress / pressure * (1.0 - np.exp(-slips / 1.0e-3))
        mean = 0.25 * math.pi * pressure
        oil, temperature = scene.lubricant, scene.temperature
        thickening = min(oil.pressure_viscosity_at(temperature) * mean, _THICKEST)
        viscous = (
            oil.dynamic_viscosity(temperature) * math.exp(thickening) * speed / self._film(film, load) / mean
        )
        sheared: Float = law.limiting_shear * (1.0 - np.exp(-viscous / law.limiting_shear * slips))
        if law.film_traction == "bair_winer":
            return sheared
        cp, mm_s = 1e3 * scene.lubricant.dynamic_viscosity(scene.temperature), 1e3 * speed
        kgf = pressure / (1.0e6 * _STANDARD_GRAVITY)
        slide = min(1.2448e7 * cp**-1.5 * mm_s**-0.75 * kgf**-1.5, law.largest_slide)
        highest = 4.078e-2 * kgf**0.18 if kgf > 94.404 else 1.008e-4 * kgf**1.5
        fitted = highest * cp**0.1 * mm_s**-0.12 * (1.0 - np.exp(-2.6 * slips / slide))
        share = min(max(math.log2(pressure / NO_LONGER_FITTED), 0.0), 1.0)
        return sheared + share * (fitted - sheared)
