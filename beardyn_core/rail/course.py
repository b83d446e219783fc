"""Curvature and cant under the wheel, and the forces on the vehicle that follow from them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.rail.vehicle import BODY, BOGIE, BOX, GRAVITY, WHEEL
from beardyn_core.rail.wheelset import HALF_GAUGE
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.running import Curve


@dataclass(frozen=True)
class Course:
    """The track's plan along the run, in the axes of the track: y to the left, z off its plane."""

    curvature: A[Float, "shape [step], positive where the track turns left, [1/m]"]
    lean: A[
        Float,
        "shape [step], unbalanced lateral acceleration that the vehicle feels, positive to the left, [m/s^2]",
    ]
    press: A[
        Float, "shape [step], what it feels at right angles to the track beyond gravity, downwards, [m/s^2]"
    ]


def course(curves: tuple[Curve, ...], position: Float, speed: Float) -> Course:
    """Compute curvature and cant along a run over curves, from place [m] and speed [m/s] at each step.

    References
    ----------
    Unbalanced acceleration v^2 / R - g h / s with the cant h over the distance s of the rolling circles:
    EN 14363; here without the small-angle step.
    """
    place, bend, tilt = [0.0], [0.0], [0.0]
    for curve in curves:
        side = 1.0 if curve.hand == "left" else -1.0
        place += [curve.begin, curve.begin + curve.transition, curve.end - curve.transition, curve.end]
        bend += [0.0, side / curve.radius, side / curve.radius, 0.0]
        tilt += [0.0, side * curve.cant, side * curve.cant, 0.0]
    curvature = np.interp(position, place, bend)
    sine = np.interp(position, place, tilt) / (2.0 * HALF_GAUGE)
    cosine = np.sqrt(1.0 - sine**2)
    outwards = speed**2 * curvature
    return Course(
        curvature=curvature,
        lean=GRAVITY * sine - outwards * cosine,
        press=GRAVITY * (cosine - 1.0) + outwards * sine,
    )


def load_transfer(operation: QuarterVehicleOperation, mounting: Mounting, plan: Course) -> Float:
    """Compute the upward forces on the left axlebox's share in a curve, quasi-static.

    Bogie and body lean on the two axleboxes of an axle, half the axlebox spacing from its middle; the
    wheels stand closer, and the wheelset rolls about them with the lateral force of the rails at its feet:
    what the wheel carries beyond the journal for that acts on the wheelset. Shape [step, 4]: on body, bogie,
    half wheelset and axlebox, [N].

    The lean of the body on its springs, which shifts its centre of mass outwards, is neglected (it adds
    10 to 20 % to the transfer); so is the share of an anti-roll bar, for both end at the axleboxes.
    """
    guidance, radius = operation.vehicle.guidance, 0.5 * operation.wheel_diameter
    half_spacing = 0.5 * guidance.axlebox_spacing
    body, bogie = operation.body_mass / 8.0, operation.vehicle.bogie_mass / 4.0
    wheelset, box = mounting.journal_mass, mounting.box_mass
    at_box = np.array(
        [
            body * (guidance.body_height - radius) / half_spacing,
            bogie * (guidance.bogie_height - radius) / half_spacing,
        ]
    )
    about_rail = (
        body * guidance.body_height + bogie * guidance.bogie_height + (wheelset + box) * radius
    ) / HALF_GAUGE
    force = np.empty((len(plan.lean), 4))
    force[:, BODY] = -plan.lean * at_box[0] - plan.press * body
    force[:, BOGIE] = -plan.lean * at_box[1] - plan.press * bogie
    force[:, WHEEL] = -plan.lean * (about_rail - at_box.sum()) - plan.press * wheelset
    force[:, BOX] = -plan.press * box
    return force
