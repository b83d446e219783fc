"""Small compiled entries around the cages' kernels, beside `entries`."""

from __future__ import annotations

from typing import Any

from beardyn_core.base.jit import entry
from beardyn_core.physics.cage.land import land_contact, short_bearing
from beardyn_core.physics.cage.play import bar_loads
from beardyn_core.physics.cage.pocket import kinematic_pocket, rotating_pocket
from test.kernels.entries import pocket_of, store_walls


@entry
def rotating_pockets(lanes: Any, states: Any, out: Any, roller: Any, cage: Any) -> None:
    """As `entries.pockets`, of a rotating cage."""
    for case in range(states.shape[0]):
        contact = rotating_pocket(pocket_of(lanes, states, case, 0.0, 0.0), roller, cage)
        store_walls(lanes, out, case, contact.walls)


@entry
def kinematic_pockets(lanes: Any, states: Any, out: Any, roller: Any, cage: Any) -> None:
    """As `entries.pockets`, of a kinematic cage."""
    for case in range(states.shape[0]):
        contact = kinematic_pocket(pocket_of(lanes, states, case, 0.0, 0.0), cage, cage.kinematic)
        store_walls(lanes, out, case, contact.walls)


@entry
def bars(lanes: Any, cases: Any, out: Any, spin: Any, radius: Any, step: Any, loose: Any) -> None:
    """Load and friction of the nearer bar; depth and speed of closing of each case."""
    for case in range(cases.shape[0]):
        depth, closing = lanes.load(cases, case, 0), lanes.load(cases, case, 1)
        load, friction = bar_loads(depth, closing, spin, radius, step, loose)
        lanes.store(out, case, 0, load)
        lanes.store(out, case, 1, friction)


@entry
def lands(bodies: Any, out: Any, body: Any, lift: Any, land: Any) -> None:
    """Force, moment, lost force, lost moment, elastic energy of a land into out [13]."""
    force, moment, lost_force, lost_moment, energy = land_contact(bodies, body, lift, land)
    for i in range(3):
        out[i], out[3 + i], out[6 + i], out[9 + i] = force[i], moment[i], lost_force[i], lost_moment[i]
    out[12] = energy


@entry
def journals(cases: Any, out: Any, land: Any) -> None:
    """Land film about +y: eccentricity x, z, velocity x, z, speed sum into force x, z, ratio."""
    for case in range(cases.shape[0]):
        force, ratio = short_bearing(
            (cases[case, 0], 0.0, cases[case, 1]), (cases[case, 2], 0.0, cases[case, 3]), (0.0, 1.0, 0.0),
            cases[case, 4], land,
        )  # fmt: skip
        out[case, 0], out[case, 1], out[case, 2] = force[0], force[2], ratio
