"""Small compiled entries around rolling resistance and drag; see `entries`."""

from __future__ import annotations

from typing import Any

from beardyn_core.base.jit import entry
from beardyn_core.physics.bodies.contact_output import load_vector, store_vector
from beardyn_core.physics.bodies.orbit import Body, View
from beardyn_core.physics.drag import prepare_drag, push_drag
from beardyn_core.physics.lanes.solve import add_couple
from beardyn_core.physics.lanes.vectors import Wrench
from beardyn_core.physics.rolling_resistance import rolling_couple


@entry
def rolling_couples(lanes: Any, cases: Any, out: Any, ring: Any, rolling: Any) -> None:
    """Couple of contacts with load and entrainment speed [case, 2, lane]."""
    for case in range(cases.shape[0]):
        couple = rolling_couple(lanes.load(cases, case, 0), lanes.load(cases, case, 1), ring, rolling)
        lanes.store(out, case, 0, couple + lanes.constant(0.0))


@entry
def drags(lanes: Any, states: Any, out: Any, drag: Any) -> None:
    """Force and moment of the medium at the beginning of a step.

    Inputs: place, axis, velocity, omega, then origin, axis, velocity and omega of the cup.
    """
    for case in range(states.shape[0]):
        zero = lanes.constant(0.0)
        body = Body(
            load_vector(lanes, states, case, 0),
            load_vector(lanes, states, case, 3),
            load_vector(lanes, states, case, 6),
            load_vector(lanes, states, case, 9),
            zero,
        )
        view = View(
            load_vector(lanes, states, case, 12),
            load_vector(lanes, states, case, 15),
            load_vector(lanes, states, case, 18),
            load_vector(lanes, states, case, 21),
        )
        still = (zero, zero, zero)
        wrench = push_drag(Wrench(still, still), prepare_drag(body, view, drag), drag)
        store_vector(lanes, out, case, 0, wrench.force)
        store_vector(lanes, out, case, 3, wrench.moment)


@entry
def couple_matrices(lanes: Any, cases: Any, out: Any) -> None:
    """A rotary damper about a direction added to a zero matrix: direction and weight, 21 outputs."""
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        empty = (
            zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero,
            zero, zero, zero, zero, zero,
        )  # fmt: skip
        m = add_couple(empty, load_vector(lanes, cases, case, 0), lanes.load(cases, case, 3))
        for i in range(7):
            store_vector(lanes, out, case, 3 * i, (m[3 * i], m[3 * i + 1], m[3 * i + 2]))
