"""Static solutions of the load cases, with and without the effect that a rule asks about."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.kinematics import centrifugal_force
from beardyn_core.bearing.spherical import FEWEST_OF_ELLIPSE
from beardyn_core.choice.load_cases import LoadCase
from beardyn_core.effects import LaminaCoupling
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.modal_body import body_of
from beardyn_core.physics.statics.initial_equilibrium import rest_under
from beardyn_core.physics.statics.roller_equilibrium import spring_params
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.scene.scene import Scene

USUAL_LAMINAE = 6
_ITERATIONS = 40
_SMALLEST, _LONGEST = 1.0e-12, 2.0e-5  # [m]
_SOFT = 1.0e3  # what holds a cone that touches nothing [N/m]


class Statics:
    """Equilibria of the bearing of a scene with the reference's effects, each solved once."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._known: dict[tuple[object, ...], StaticSolution | None] = {}
        self.body = body_of(scene)

    @property
    def flexible(self) -> bool:
        """Whether the reference's cup bends."""
        return self.body is not None

    def at(
        self,
        case: LoadCase,
        *,
        laminae: int = 0,
        coupling: LaminaCoupling | None = None,
        bending: bool = False,
    ) -> StaticSolution | None:
        """Solve the equilibrium under a load case; ``None`` where there is none.

        ``laminae``: as usual for the kind of bearing when left out.
        """
        if laminae == 0:
            barrels = self.scene.bearing.self_aligning
            laminae = FEWEST_OF_ELLIPSE if barrels else USUAL_LAMINAE
        key = (case, laminae, coupling, bending)
        if key not in self._known:
            self._known[key] = self._solve_case(*key)
        return self._known[key]

    def _solve_case(
        self, case: LoadCase, laminae: int, coupling: LaminaCoupling | None, bending: bool
    ) -> StaticSolution | None:
        body = self.body if bending else None
        wrench = [*case.force, *case.moment]
        try:
            return rest_under(self.scene, body, wrench, case.speed, laminae=laminae, coupling=coupling).static
        except (InputError, ValidityError):
            return None

    def solve_lumped(self, case: LoadCase, laminae: int) -> tuple[float, float] | None:
        """Compute the deflection [m] and largest roller load [N] of the springs of the lumped tier."""
        exact = self.at(case)
        if exact is None:
            return None
        bearing = self.scene.bearing
        try:
            spring = spring_params(bearing, max(laminae, bearing.usual_laminae))
        except np.linalg.LinAlgError:  # laminae that a profile keeps out of contact
            return None
        azimuth = 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
        sine, cosine = np.sin(bearing.cup_slant), np.cos(bearing.cup_slant)
        sides = (-1.0, 1.0)[: self.scene.rows]
        there = Arrangement(azimuth.size, 1, self.scene.rows, self.scene.missing_places).present.ravel()
        normals = [
            np.stack(
                [cosine * np.sin(azimuth), np.full(azimuth.size, -side * sine), cosine * np.cos(azimuth)], 1
            )
            for side in sides
        ]
        # the tilt of the exact solution is kept: the lengths of the rollers hold it in both
        tilting = [
            spring.lever * side * (np.cos(azimuth) * exact.tilt[0] - np.sin(azimuth) * exact.tilt[1])
            for side in sides
        ]
        normal = np.concatenate(normals)[there]
        offset = np.concatenate(tilting)[there] - bearing.normal_gap(self.scene.end_play)
        springs = np.array([0.0, self.scene.mounting.axial_prop_stiffness, 0.0])
        found, load = exact.displacement.copy(), np.array(case.force)
        if sine == 0.0:  # along the axle ribs hold, at the place of the exact solution
            load[1], springs[1] = 0.0, 0.0
        idle = spring.idle * centrifugal_force(bearing, case.speed)
        force = np.zeros(len(normal))
        for _ in range(_ITERATIONS):
            approach = normal @ found + offset
            root = np.maximum(approach, _SMALLEST) ** (1.0 / 9.0)
            pressed = (
                np.maximum(approach, 0.0)
                * root
                * (root[:, None] ** np.arange(len(spring.series)) @ spring.series)
            )
            force = np.maximum(pressed + 0.5 * idle, idle)
            tangent = 10.0 / 9.0 * pressed / np.maximum(approach, _SMALLEST) * (pressed > 0.5 * idle)
            step = np.linalg.solve(
                (normal * tangent[:, None]).T @ normal + np.diag(_SOFT + springs),
                load - force @ normal - springs * found,
            )
            found = found + step * min(1.0, _LONGEST / max(float(np.abs(step).max()), _SMALLEST))
            if np.abs(step).max() < _SMALLEST:
                break
        return float(np.linalg.norm(found)), float(force.max())
