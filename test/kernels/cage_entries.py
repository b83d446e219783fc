"""Small compiled entries around the cages' kernels, beside `entries`."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import entry
from beardyn_core.kernels.exchange import load_vector, store_vector
from beardyn_core.kernels.land import land_contact, short_bearing
from beardyn_core.kernels.pocket_simple import kinematic_pocket, rotating_pocket


@entry
def rotating_pockets(lanes: Any, states: Any, out: Any, roller: Any, cage: Any) -> None:
    """As `entries.pockets`, of a rotating cage."""
    for case in range(states.shape[0]):
        motion = (
            load_vector(lanes, states, case, 9), load_vector(lanes, states, case, 12),
            load_vector(lanes, states, case, 15), load_vector(lanes, states, case, 18),
        )  # fmt: skip
        touches, _slip, _bar = rotating_pocket(
            load_vector(lanes, states, case, 0), load_vector(lanes, states, case, 3), motion,
            lanes.load(states, case, 21), load_vector(lanes, states, case, 6), 0.0, roller, cage,
        )  # fmt: skip
        force, moment, energy = touches[0], touches[1], touches[2]
        store_vector(lanes, out, case, 0, force)
        store_vector(lanes, out, case, 3, moment)
        lanes.store(out, case, 6, energy)


@entry
def kinematic_pockets(lanes: Any, states: Any, out: Any, roller: Any, cage: Any) -> None:
    """As `entries.pockets`, of a kinematic cage."""
    for case in range(states.shape[0]):
        motion = (
            load_vector(lanes, states, case, 9), load_vector(lanes, states, case, 12),
            load_vector(lanes, states, case, 15), load_vector(lanes, states, case, 18),
        )  # fmt: skip
        touches, _slip, _bar = kinematic_pocket(
            load_vector(lanes, states, case, 0), load_vector(lanes, states, case, 3), motion,
            lanes.load(states, case, 21), load_vector(lanes, states, case, 6), cage, cage.kinematic,
        )  # fmt: skip
        force, moment, energy = touches[0], touches[1], touches[2]
        store_vector(lanes, out, case, 0, force)
        store_vector(lanes, out, case, 3, moment)
        lanes.store(out, case, 6, energy)


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
