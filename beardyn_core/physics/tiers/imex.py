"""Linearly implicit steps of the full tier: rollers implicit one by one, rings and cages explicit."""

from __future__ import annotations

from beardyn_core.base.jit import entry, inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import clear_largest
from beardyn_core.physics.bodies.friction_substeps import is_fresh
from beardyn_core.physics.bodies.rigid_bodies import (
    collect_energy,
    collect_reactions,
    drift_bodies,
    show_rings,
    sum_lanes,
)
from beardyn_core.physics.bodies.stage_timer import mark, time_step
from beardyn_core.physics.bodies.step_stages import CAGE, LOSS, RINGS
from beardyn_core.physics.cage.drag import brake_cages
from beardyn_core.physics.cage.land import land_of, push_lands, settle_lands
from beardyn_core.physics.cage.motion import (
    cage_energy,
    cage_motions,
    move_cages,
    pass_on,
    place_cages,
    settle_cages,
)
from beardyn_core.physics.journal import add_bending, axle_energy, kick_journal
from beardyn_core.physics.lanes.lanes import align_stack
from beardyn_core.physics.ring_modes import kick_structure, show_structure, structure_energy
from beardyn_core.physics.seal import add_seals
from beardyn_core.physics.suspension import box_energy, kick_box
from beardyn_core.physics.tiers.roller import step_rollers


@inline
def kinetic_energy(rollers, bodies, axle, p):
    """Sum the kinetic energy of rollers, cages, axlebox and journal without its prescribed spin, [J]."""
    roller = p.roller
    total = 0.0
    for block in range(rollers.shape[0]):
        for lane in range(rollers.shape[2]):
            speed2, momentum2, along = 0.0, 0.0, 0.0
            for i in range(3):
                v = rollers[block, layout.VELOCITY + i, lane]
                momentum = rollers[block, layout.MOMENTUM + i, lane]
                speed2 += v * v
                momentum2 += momentum * momentum
                along += momentum * rollers[block, layout.AXIS + i, lane]
            spinning = along * along / roller.axial_inertia
            tumbling = (momentum2 - along * along) / roller.transverse_inertia
            energy = 0.5 * (roller.mass * speed2 + spinning + tumbling)
            total += p.rollers[block, layout.MASK, lane] * energy
    mounting = p.mounting
    add_bending(bodies, axle, -1.0, mounting.journal)
    for i in range(3):
        total += 0.5 * mounting.journal_mass * bodies[layout.CONE_BODY, layout.LINEAR + i] ** 2
        total += 0.5 * mounting.journal_inertia * bodies[layout.CONE_BODY, layout.ANGULAR + i] ** 2
    add_bending(bodies, axle, 1.0, mounting.journal)
    total += axle_energy(axle, mounting.journal)
    total += box_energy(bodies, mounting, mounting.coupling)
    return total + cage_energy(bodies, p.effects.cage)


@inline
def cage_place(cage):
    """Take the axial place of the cages' centres from the middle plane, 0 without cages, [m]."""
    if cage is None:
        return 0.0
    return cage.place


@inline
def clear_block_sums(rollers):
    """Start the chatter sums and the largest penetration of a block anew."""
    for block in range(rollers.shape[0]):
        for lane in range(rollers.shape[2]):
            for ring in range(2):
                first = layout.CHATTER + ring * layout.CHATTER_FIELDS
                rollers[block, first + layout.CHATTER_SQUARES, lane] = 0.0
                rollers[block, first + layout.CHATTER_LOAD, lane] = 0.0
            rollers[block, layout.PENETRATION, lane] = 0.0


# Loops instead of array assignments: numba compiles the text of a broadcasting error with each of those, a
# tenth of the time that the whole step takes to compile.


@inline
def copy_sums(source, target):
    """Copy an array of one axis."""
    for i in range(source.shape[0]):
        target[i] = source[i]


@inline
def keep_trend(rollers, bodies, output, index):
    """Copy the state of rollers and bodies into the trends."""
    for i in range(rollers.shape[0]):
        for j in range(rollers.shape[1]):
            for k in range(rollers.shape[2]):
                output.rollers[index, i, j, k] = rollers[i, j, k]
    for i in range(bodies.shape[0]):
        for j in range(bodies.shape[1]):
            output.bodies[index, i, j] = bodies[i, j]


@entry
def advance(lanes, state, work, loads, output, p):
    """Advance the full tier over one block of steps: ``state`` is changed in place and ``output`` written.

    ``loads`` [step + 1, 10]: load [N, N m], shaft speed [rad/s] and bogie displacement [m] at the step
    boundaries; ``work``: a `WorkSpace`.
    """
    rollers, bodies, energy, flex, axle = state.rollers, state.bodies, state.energy, state.flex, state.axle
    rings, sums, wrenches, box, bend, _ = work
    signals, audit = output.signals, output.audit
    align_stack(lanes)
    steps = signals.shape[0]
    stride = steps // output.rollers.shape[0]
    groups = rings.shape[0]
    blocks_per_group = rollers.shape[0] // groups
    clear_block_sums(rollers)
    effects = p.effects
    cage, structure, timers = effects.cage, effects.structure, effects.timers
    place, land = cage_place(cage), land_of(cage)
    for step in range(steps):
        time_step(timers, step)
        drift_bodies(bodies, p.step)
        place_cages(bodies, cage)
        show_rings(bodies, rings, place)
        show_structure(lanes, flex, box, p.step, bend, structure)
        sums[:] = 0.0
        if step == 0:
            copy_sums(energy, audit)
            audit[layout.ENERGY_KINETIC] = kinetic_energy(rollers, bodies, axle, p) + structure_energy(
                flex, structure
            )
        mark(timers, RINGS)
        shown = (step + 1) % stride == 0
        fresh = shown or is_fresh(step, p.held)
        for group in range(groups):
            for index in range(blocks_per_group):
                block = group * blocks_per_group + index
                step_rollers(lanes, block, rollers, rings[group], sums[group], bend.lanes[group], fresh, p)
        collect_reactions(sums, wrenches)
        mark(timers, RINGS)
        lands = push_lands(bodies, wrenches, cage, land)
        pass_on(bodies, wrenches, energy, p.step, cage, effects.gravity)
        mark(timers, CAGE)
        for i in range(6):
            signals[step, layout.SIGNAL_FORCE + i] = wrenches[layout.CUP_BODY, i]
        add_seals(bodies, wrenches, energy, p.step, effects.seal)
        brake_cages(bodies, wrenches, energy, p.step, effects.cage_drag)
        mark(timers, LOSS)
        stored = kick_box(
            bodies, wrenches[layout.CUP_BODY], loads[step + 1], loads[step], energy, box, p.step, p.mounting,
            effects.gravity, p.mounting.coupling,
        )  # fmt: skip
        for i in range(6):
            signals[step, layout.SIGNAL_ACCELERATION + i] = box[i]
        signals[step, layout.SIGNAL_TORQUE], propped = kick_journal(
            bodies, axle, wrenches[layout.CONE_BODY], loads[step + 1], energy, p.step, p.mounting,
            p.mounting.journal,
        )  # fmt: skip
        stored += propped
        mark(timers, RINGS)
        before = cage_motions(bodies, cage, effects.audit)
        move_cages(bodies, wrenches, energy, p.step, cage, effects.gravity)
        stored -= settle_cages(bodies, before, sums, energy, p.step, cage, effects.audit)
        stored += settle_lands(bodies, lands, energy, p.step, cage, land)
        mark(timers, CAGE)
        stored += kick_structure(flex, sums, box, signals[step], energy, p.step, bend, structure)
        collect_energy(sums, energy, effects, effects.audit)
        mark(timers, RINGS)
        if step == 0:
            for i in range(layout.ENERGY_WORKS, audit.shape[0]):
                audit[i] = 0.5 * (audit[i] + energy[i])
            audit[layout.ENERGY_ELASTIC] = sum_lanes(sums, layout.ELASTIC) + stored
            audit[layout.ENERGY_KINETIC] = 0.5 * (
                audit[layout.ENERGY_KINETIC]
                + kinetic_energy(rollers, bodies, axle, p)
                + structure_energy(flex, structure)
            )
        if shown:
            trends = (step + 1) // stride
            keep_trend(rollers, bodies, output, trends - 1)
            if trends % layout.TRENDS_PER_SNAPSHOT == 0:
                clear_largest(rollers)
