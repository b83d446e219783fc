"""Entries of the fault kernels: patches, waviness, worn pockets, and a raceway contact with all of them."""

from __future__ import annotations

from typing import Any

from beardyn_core.base.jit import entry, inline
from beardyn_core.physics.bodies.contact_output import load_vector, store_vector
from beardyn_core.physics.bodies.orbit import Body, View
from beardyn_core.physics.cage.pocket import free_pocket
from beardyn_core.physics.cage.pocket_wear import pocket_length, pocket_wear
from beardyn_core.physics.defect import (
    find_damage,
    soften_by_edges,
    spring_damage,
    spring_slopes,
)
from beardyn_core.physics.lamina_springs import cup_springs, lamina_springs
from beardyn_core.physics.laminae import released_power
from beardyn_core.physics.lanes.lane_tables import gather_pair
from beardyn_core.physics.lanes.vectors import Twist, dot, scale
from beardyn_core.physics.raceway import Ring, faults_of_cup, prepare_raceway, settled_contact
from beardyn_core.physics.rolling_waves import fetch_waves, subtract_waviness, wave_places
from beardyn_core.physics.tiers.massless_roller import faulted_load, over_patches
from beardyn_core.physics.tiers.planar_roller import cone_waves
from beardyn_core.physics.waviness import wave_gap
from test.kernels.entries import pocket_of


@entry
def patch_springs(
    lanes: Any, cases: Any, out: Any, block: Any, count: Any, surfaces: Any, damage: Any
) -> None:
    """Damaged springs of a contact at azimuths in ring and roller and a depth, all cases seen by one block.

    Outputs by lamina: share, gap, slope over the ring's and over the roller's azimuth, share of the
    stiffness lost; zeros elsewhere.
    """
    for case in range(cases.shape[0]):
        both, depth = (lanes.load(cases, case, 0), lanes.load(cases, case, 1)), lanes.load(cases, case, 2)
        near = 1.0 if find_damage(lanes, block, both, count, surfaces, damage) else 0.0
        for k in range(count):
            share, gap = spring_damage(lanes, count + k, damage)
            ring_slope, roller_slope = spring_slopes(lanes, count + k, depth, damage)
            firmness = soften_by_edges(lanes, lanes.constant(1.0), count + k, damage)
            lanes.store(out, case, 5 * k, share * near)
            lanes.store(out, case, 5 * k + 1, gap * near)
            lanes.store(out, case, 5 * k + 2, ring_slope * near)
            lanes.store(out, case, 5 * k + 3, roller_slope * near)
            lanes.store(out, case, 5 * k + 4, (1.0 - firmness) * near)


@entry
def seen_by_sound_rollers(lanes: Any, cases: Any, out: Any) -> None:
    """Rollers of the lumped tier over patches: inputs approach and moments, outputs approach and slope."""
    for case in range(cases.shape[0]):
        moments = load_vector(lanes, cases, case, 1)
        approach, slope = over_patches(lanes.load(cases, case, 0), moments)
        lanes.store(out, case, 0, approach)
        lanes.store(out, case, 1, slope)


@entry
def wave_gaps(lanes: Any, azimuths: Any, out: Any, block: Any, waves: Any) -> None:
    """Waviness at azimuths, all cases seen by one block: gap and slope."""
    for case in range(azimuths.shape[0]):
        gap, slope = wave_gap(lanes, block, lanes.load(azimuths, case, 0), waves)
        lanes.store(out, case, 0, gap)
        lanes.store(out, case, 1, slope)


@entry
def rolling_gaps(lanes: Any, turns: Any, out: Any, block: Any, waves: Any) -> None:
    """What waviness takes off the approach of a block at angles of cages, cone and spin [rad]."""
    for case in range(turns.shape[0]):
        places = wave_places((turns[case, 0], turns[case, 1], turns[case, 2]), waves)
        fetch_waves(lanes, block, places, waves)
        lanes.store(out, case, 0, subtract_waviness(lanes, block, lanes.constant(0.0), places, waves))


@entry
def pairs_in_table(lanes: Any, indices: Any, out: Any, table: Any) -> None:
    """Two points of a table beside each other, in one look and in two."""
    for case in range(indices.shape[0]):
        index = lanes.load(indices, case, 0)
        low, high = gather_pair(lanes, table, index)
        lanes.store(out, case, 0, low)
        lanes.store(out, case, 1, high)
        lanes.store(out, case, 2, lanes.gather(table, index))
        lanes.store(out, case, 3, lanes.gather(table, index + 1.0))


@entry
def waves_on_cone(lanes: Any, cases: Any, out: Any, block: Any, faults: Any, highest: Any) -> None:
    """Gap of waviness on the cone, where it matters and always: inputs nearest approach, azimuth, spin."""
    for case in range(cases.shape[0]):
        azimuth, spin = lanes.load(cases, case, 1), lanes.load(cases, case, 2)
        azimuths, nearest = (azimuth, azimuth, spin), lanes.load(cases, case, 0)
        for k, bound in enumerate((highest, 1.0)):
            gap = cone_waves(lanes, block, nearest, azimuths, faults, bound, faults.cone_damage)
            lanes.store(out, case, k, gap)


@entry
def worn_pockets(lanes: Any, states: Any, out: Any, block: Any, worn: Any, roller: Any, cage: Any) -> None:
    """Pocket force of each case, inputs as `entries.pockets`, all cases in the pockets of one block."""
    for case in range(states.shape[0]):
        wear = pocket_wear(lanes, block, worn) + lanes.constant(0.0)
        length = pocket_length(lanes, block, worn) + lanes.constant(0.0)
        contact = free_pocket(pocket_of(lanes, states, case, wear, length), roller, cage)
        store_vector(lanes, out, case, 0, contact.walls.force)
        store_vector(lanes, out, case, 3, contact.walls.moment)


@inline
def cup_contact(lanes: Any, cases: Any, case: Any, velocity: Any, rates: Any, p: Any) -> Any:
    """Cup contact of a case: inputs azimuth in ring and roller, place and axis of the roller."""
    zero = lanes.constant(0.0)
    nothing = (zero, zero, zero)
    view = View(nothing, (zero, zero, zero + 1.0), nothing, nothing)
    place, axis = load_vector(lanes, cases, case, 2), load_vector(lanes, cases, case, 5)
    body = Body(place, axis, velocity, scale(rates[1], axis), rates[0])
    azimuths = (lanes.load(cases, case, 0), lanes.load(cases, case, 1))
    ring = Ring(0, p.cup, faults_of_cup(p.effects.faults), view)
    return prepare_raceway(lanes, 0, ring, body, zero, azimuths, True, p)


@entry
def damaged_contacts(lanes: Any, cases: Any, out: Any, p: Any) -> None:
    """Cup contact of the nominal roller: inputs azimuth in the ring and in the roller, and the roller's axis.

    Outputs: elastic energy, then force and moment of the leaning normal.
    """
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        contact = cup_contact(lanes, cases, case, (zero, zero, zero), (zero, zero), p)
        lanes.store(out, case, 0, contact.sums.energy)
        store_vector(lanes, out, case, 1, contact.lean.force)
        store_vector(lanes, out, case, 4, contact.lean.moment)


@entry
def moving_contacts(lanes: Any, cases: Any, out: Any, p: Any) -> None:
    """Inputs of `damaged_contacts` and the velocity.

    Outputs: energy, power released, stiffness, largest penetration, elastic force, its moment along the line.
    """
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        contact = cup_contact(lanes, cases, case, load_vector(lanes, cases, case, 8), (zero, zero), p)
        lanes.store(out, case, 0, contact.sums.energy)
        lanes.store(out, case, 1, released_power(contact.sums.released, contact.slip.rate))
        lanes.store(out, case, 2, contact.sums.stiffness[0])
        lanes.store(out, case, 3, contact.sums.deepest)
        lanes.store(out, case, 4, contact.sums.force[0])
        lanes.store(out, case, 5, contact.sums.force[1])


@entry
def powers(lanes: Any, cases: Any, out: Any, p: Any) -> None:
    """Inputs of `moving_contacts`, orbit rate and rate of rotation about the axis.

    Outputs: energy; power of the contact on the roller; powers of its damping and of its friction.
    """
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        velocity = load_vector(lanes, cases, case, 8)
        rates = (lanes.load(cases, case, 11), lanes.load(cases, case, 12))
        contact = cup_contact(lanes, cases, case, velocity, rates, p)
        still = (zero, zero, zero)
        settled = settled_contact(contact, Twist(still, still), 1.0, 0.0, p.effects.damping)
        work = dot(settled.wrench.force, velocity) + dot(settled.wrench.moment, contact.body.omega)
        lanes.store(out, case, 0, contact.sums.energy)
        lanes.store(out, case, 1, work)
        lanes.store(out, case, 2, settled.damped)
        lanes.store(out, case, 3, settled.slid)


@entry
def spring_contacts(lanes: Any, cases: Any, out: Any, reach: Any, p: Any) -> None:
    """Cup contact of tier quasistatic: azimuth in the cup and approach of a level roller; output: force."""
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        both, faults = (lanes.load(cases, case, 0), zero), p.effects.faults
        approach = (lanes.load(cases, case, 1), zero)
        forces, _stiffness = cup_springs(
            lanes, 0, approach, zero, both, p.laminae, reach, faults, p.effects.coupling
        )
        lanes.store(out, case, 0, forces[0])


@entry
def massless_rollers(lanes: Any, cases: Any, out: Any, p: Any) -> None:
    """Rollers of tier lumped: azimuth in the cup, approach of cup and cone, spin; output: load on the cup."""
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        angle, approach = lanes.load(cases, case, 0), lanes.load(cases, case, 1)
        turns = (zero, zero, cases[case, 2, 0])
        load = faulted_load(lanes, 0, approach, zero, angle, turns, p.faults, p)
        lanes.store(out, case, 0, load)


@entry
def barrel_springs(lanes: Any, cases: Any, out: Any, reach: Any, p: Any) -> None:
    """Cup contact of barrels in tier quasistatic: azimuth in the cup and approach; output: force."""
    for case in range(cases.shape[0]):
        zero, faults, barrel = lanes.constant(0.0), p.effects.faults, p.cup.barrel
        both, approach = (lanes.load(cases, case, 0), zero), (lanes.load(cases, case, 1), zero)
        patches, bend = (faults.cup, faults.roller, faults.cup_damage), (zero - barrel.sharpness, zero)
        forces, _stiffness = lamina_springs(
            lanes, 0, approach, bend, both, p.laminae, reach, patches, None, barrel.ellipse
        )
        lanes.store(out, case, 0, forces[0])
