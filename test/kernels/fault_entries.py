"""Entries of the fault kernels: patches, waviness, worn pockets, and a raceway contact with all of them."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import entry
from beardyn_core.kernels.defect import find_damage, pocket_wear, spring_damage, spring_slopes
from beardyn_core.kernels.exchange import load_vector, store_vector
from beardyn_core.kernels.pocket import pocket_contact
from beardyn_core.kernels.raceway_step import raceway_contact
from beardyn_core.kernels.waviness import wave_gap


@entry
def patch_springs(
    lanes: Any, azimuths: Any, out: Any, block: Any, count: Any, surfaces: Any, damage: Any
) -> None:
    """Damaged springs of a contact at azimuths in ring and roller, all cases seen by one block.

    Outputs by lamina: share, gap, slope over the ring's and over the roller's azimuth; zeros elsewhere.
    """
    for case in range(azimuths.shape[0]):
        both = (lanes.load(azimuths, case, 0), lanes.load(azimuths, case, 1))
        near = 1.0 if find_damage(lanes, block, both, count, surfaces, damage) else 0.0
        for k in range(count):
            share, gap = spring_damage(lanes, count + k, damage)
            ring_slope, roller_slope = spring_slopes(lanes, count + k, damage)
            lanes.store(out, case, 4 * k, share * near)
            lanes.store(out, case, 4 * k + 1, gap * near)
            lanes.store(out, case, 4 * k + 2, ring_slope * near)
            lanes.store(out, case, 4 * k + 3, roller_slope * near)


@entry
def wave_gaps(lanes: Any, azimuths: Any, out: Any, block: Any, waves: Any) -> None:
    """Waviness at azimuths, all cases seen by one block: gap and slope."""
    for case in range(azimuths.shape[0]):
        gap, slope = wave_gap(lanes, block, lanes.load(azimuths, case, 0), waves)
        lanes.store(out, case, 0, gap)
        lanes.store(out, case, 1, slope)


@entry
def worn_pockets(lanes: Any, states: Any, out: Any, block: Any, worn: Any, roller: Any, cage: Any) -> None:
    """Pocket force of each case, inputs as `entries.pockets`, all cases in the pockets of one block."""
    for case in range(states.shape[0]):
        wear = pocket_wear(lanes, block, worn) + lanes.constant(0.0)
        touches, _slip, _bar = pocket_contact(
            load_vector(lanes, states, case, 0),
            load_vector(lanes, states, case, 3),
            load_vector(lanes, states, case, 9),
            load_vector(lanes, states, case, 12),
            lanes.load(states, case, 21),
            load_vector(lanes, states, case, 6),
            load_vector(lanes, states, case, 15),
            load_vector(lanes, states, case, 18),
            wear,
            roller,
            cage,
        )
        store_vector(lanes, out, case, 0, touches[0])
        store_vector(lanes, out, case, 3, touches[1])


@entry
def damaged_contacts(lanes: Any, cases: Any, out: Any, p: Any) -> None:
    """Cup contact of the nominal roller: inputs azimuth in the ring and in the roller, and the roller's axis.

    Outputs: elastic energy, then force and moment of the leaning normal.
    """
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        place = load_vector(lanes, cases, case, 2)
        axis = load_vector(lanes, cases, case, 5)
        view = (nothing, (zero, zero, zero + 1.0), nothing, nothing)
        body = (place, axis, nothing, nothing, zero)
        azimuths = (lanes.load(cases, case, 0), lanes.load(cases, case, 1))
        faults = p.effects.faults
        of_cup = (faults.cup, faults.roller, faults.cup_damage, faults.cup_waves, faults.roller_waves)
        contact = raceway_contact(lanes, 0, 0, view, body, zero, azimuths, p.cup, of_cup, p)
        lanes.store(out, case, 0, contact[2][3])
        store_vector(lanes, out, case, 1, contact[2][4][0])
        store_vector(lanes, out, case, 4, contact[2][4][1])


@entry
def moving_contacts(lanes: Any, cases: Any, out: Any, p: Any) -> None:
    """Inputs of `damaged_contacts` and the velocity.

    Outputs: energy, power let go, stiffness, largest penetration, elastic force, its moment along the line.
    """
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        view = (nothing, (zero, zero, zero + 1.0), nothing, nothing)
        place, axis = load_vector(lanes, cases, case, 2), load_vector(lanes, cases, case, 5)
        body = (place, axis, load_vector(lanes, cases, case, 8), nothing, zero)
        azimuths = (lanes.load(cases, case, 0), lanes.load(cases, case, 1))
        faults = p.effects.faults
        of_cup = (faults.cup, faults.roller, faults.cup_damage, faults.cup_waves, faults.roller_waves)
        contact = raceway_contact(lanes, 0, 0, view, body, zero, azimuths, p.cup, of_cup, p)
        lanes.store(out, case, 0, contact[2][3])
        lanes.store(out, case, 1, contact[2][5])
        lanes.store(out, case, 2, contact[2][1][0])
        lanes.store(out, case, 3, contact[6])
        lanes.store(out, case, 4, contact[2][0][0])
        lanes.store(out, case, 5, contact[2][0][1])
