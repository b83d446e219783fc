"""Rest under a load: bearing, box and springs in one equilibrium, for the start of a run and for choices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.effects import LaminaCoupling
from beardyn_core.physics.defect import roller_oversize
from beardyn_core.physics.modal_body import ModalBody
from beardyn_core.physics.scatter import crown_errors
from beardyn_core.physics.statics.equilibria import equilibrium
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.suspension import MountingParams, mounting_params, tilt_restraint
from beardyn_core.scene.scene import Scene

_SETTLED = 1e-5  # of the moment of the load at the raceways: what a pass changes of the springs' moment
_PASSES = 8


class Rest(NamedTuple):
    """A bearing at rest in its box."""

    static: StaticSolution
    springs: Float  # [6], force and moment of the suspension on the box about the bearing centre [N], [N m]
    on_cone: Float  # [6], those of the rollers on the cone


def rest_under(
    scene: Scene,
    body: ModalBody | None,
    wrench: ArrayLike,
    speed: float,
    *,
    laminae: int,
    coupling: LaminaCoupling | None,
) -> Rest:
    """Find the rest of a scene's bearing under a load on its journal.

    Parameters
    ----------
    body : ModalBody or None
        How the box bends; ``None`` for a rigid one.
    wrench : array_like, shape [6]
        Force and moment about the bearing centre, [N], [N m].
    speed : float
        Of the shaft, [rad/s].
    laminae, coupling :
        As of `beardyn_core.physics.statics.static.solve`; slices of barrels are not coupled.

    Raises
    ------
    InputError, ValidityError
        As `solve`.

    Notes
    -----
    The springs bend the box at their seats by what they carry. That depends on the tilt and the axial way of
    the journal, which depend on the bent box: a few passes settle both.
    """
    bearing, held = scene.bearing, scene.mounting
    if coupling is not None and not coupling.about.suits(bearing.kind):
        coupling = None
    box = mounting_params(bearing, held, np.zeros(6), None if body is None else body.modes)
    restraint = tilt_restraint(held, box)
    seats = None if body is None else body.suspension
    free = held.journal_tilt == "free" or held.cup == "suspended"
    fx, fy, fz, mx, _, mz = map(float, np.asarray(wrench)[:6])
    force, moment = (fx, fy, fz), (mx, 0.0, mz)
    arm = 0.5 * bearing.pitch_diameter
    enough = _SETTLED * (arm * max(map(abs, force)) + max(map(abs, moment)))
    prop, tilt, near = 0.0, np.zeros(2), None
    for _ in range(_PASSES):
        springs = springs_under(scene, box, reaction([*force, *moment], prop, restraint * tilt))
        static = equilibrium(
            bearing,
            force,
            moment if free else (0.0, 0.0, 0.0),
            end_play=scene.end_play,
            tilt="free" if free else "locked",
            laminae=laminae,
            speed=float(speed),
            coupling=coupling,
            oversize=roller_oversize(scene),
            crown=crown_errors(scene),
            body=body,
            modal_load=() if seats is None else tuple((springs @ seats).tolist()),
            tilt_stiffness=tuple(restraint.tolist()),
            axial_stiffness=held.axial_prop_stiffness,
            rows=scene.rows,
            missing=scene.missing_places,
            near=near,
        )
        near = static.place
        prop = held.axial_prop_stiffness * float(static.displacement[1])
        settled = np.abs(restraint * (static.tilt - tilt)).max() <= enough
        tilt = static.tilt
        if seats is None or settled:
            break
    on_cone = reaction([*force, *moment], prop, restraint * tilt)
    springs = springs_under(scene, box, on_cone)
    if seats is not None and box.coupling is not None:
        springs += box.coupling.stiffness @ (seats @ static.bending)
    return Rest(static, springs, on_cone)


def reaction(wrench: ArrayLike, prop: float, tilted: Float) -> Float:
    """Balance the journal under a load [6], less what prop [N] and restraint of the tilt [N m] take, [6]."""
    force = -np.asarray(wrench, dtype=float)
    force[1] += prop
    force[[3, 5]] += tilted
    return force


def springs_under(scene: Scene, box: MountingParams, on_cone: ArrayLike) -> Float:
    """Balance the box under what the rollers do to the cone, [6]."""
    force = np.array(on_cone, dtype=float)
    force[2] += weight_on_cone(scene) + _free_fall(scene) * box.box_mass
    if box.coupling is not None:
        force[3:] -= _free_fall(scene) * box.coupling.weight[3:]
    return force


def weight_on_cone(scene: Scene) -> float:
    """Compute the weight of rollers and cages, which the cone carries on top of the cup's force, [N]."""
    bearing = scene.bearing
    cages = scene.rows * bearing.cage.mass if scene.effects.cage else 0.0
    return _free_fall(scene) * (scene.roller_total * bearing.roller_mass + cages)


def _free_fall(scene: Scene) -> float:
    return scene.effects.gravity.acceleration if scene.effects.gravity else 0.0
