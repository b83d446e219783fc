"""What a run starts from: the state in static equilibrium, rolling at its first speed."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.arrangement import Arrangement, aligned_zeros
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.tiers.massless_flanges import thrust_at
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.state import State
from beardyn_core.physics.tiers.tier_bending import openings_at_pockets
from beardyn_core.physics.tiers.tier_parameters import LumpedParameters

_ITERATIONS = 200
_HALVINGS = 20
_TOLERANCE = 1e-9
# Where no roller holds the cone in some direction it wanders there: what is missing then is as good as none.
_ACCEPTABLE, _ACCEPTABLE_FORCE = 1e-8, 1e-2  # of the load; [N]


def kinematic_spin(bearing: RollerBearing, cage_speed: float) -> float:
    """Work out the spin of a roller, rolling on the cup, about its axis in the orbit frame, [rad/s]."""
    cup, roller = bearing.rolling_radii
    return -cage_speed * cup / roller


def initial_state(
    bearing: RollerBearing,
    arrangement: Arrangement,
    parameters: Parameters,
    static: StaticSolution,
    shaft_speed: float,
    cage_speed: float,
) -> State:
    """Make the state in static equilibrium under the first load, rolling at the given speeds [rad/s].

    Each roller stands in the middle of its own pocket along the pitch circle.
    """
    lanes = arrangement.to_lanes
    rollers = aligned_zeros(arrangement.block_count, layout.ROLLER_FIELDS, arrangement.width)
    angle = bearing.roller_slant + lanes(static.roller_tilt)
    offset = bearing.roller_mass_offset
    radial, axial = _places_in_cup(bearing, static)
    radius = 0.5 * bearing.pitch_diameter + lanes(radial) + offset * np.sin(angle)
    rollers[:, layout.RADIUS] = radius
    rollers[:, layout.ANGLE] = parameters.rollers[:, layout.POCKET_ANGLE]
    rollers[:, layout.AXIAL] = 0.5 * bearing.row_spacing + lanes(axial) + offset * np.cos(angle)
    rollers[:, layout.VELOCITY + 1] = cage_speed * radius
    sine, cosine = np.sin(angle), np.cos(angle)
    rollers[:, layout.AXIS], rollers[:, layout.AXIS + 2] = sine, cosine

    spin = kinematic_spin(bearing, cage_speed)
    about = bearing.roller_axial_inertia * (spin + cage_speed * cosine)
    across = bearing.roller_transverse_inertia * cage_speed
    # omega = spin b + cage_speed e_axial, split along and across the roller axis b
    rollers[:, layout.MOMENTUM] = about * sine - across * cosine * sine
    rollers[:, layout.MOMENTUM + 2] = about * cosine + across * sine * sine

    bodies = np.zeros((layout.CAGE_BODY + arrangement.rows, layout.BODY_STATES))
    bodies[layout.CONE_BODY, layout.POSITION : layout.POSITION + 3] = static.displacement
    bodies[layout.CONE_BODY, layout.TILT], bodies[layout.CONE_BODY, layout.TILT + 2] = static.tilt
    bodies[layout.CONE_BODY, layout.RATE] = shaft_speed
    bodies[layout.CAGE_BODY :, layout.RATE] = cage_speed
    outward = np.array([-1.0, 1.0])[: arrangement.rows]
    shift = _shift_of_cages(bearing, arrangement, parameters, static)
    bodies[layout.CAGE_BODY :, layout.POSITION + 1] = outward * shift
    structure = parameters.effects.structure
    flex = np.zeros((2, 0 if structure is None else len(structure.shapes)))
    flex[0, : len(static.bending)] = static.bending[: flex.shape[1]]
    journal = parameters.mounting.journal
    axle = np.zeros((2, 2, 0 if journal is None else len(journal.place)))
    return State(rollers, bodies, np.zeros(ENERGY_TERMS), flex, axle)


def _places_in_cup(bearing: RollerBearing, static: StaticSolution) -> tuple[Float, Float]:
    """Place the rollers against the cup, radially and axially, [row, roller] [m]; barrels follow the cone."""
    radial, axial = static.roller_radial, static.roller_axial
    if not bearing.self_aligning:
        return radial, axial
    azimuth = 2.0 * math.pi * np.arange(radial.shape[1]) / radial.shape[1]
    outward = np.array([-1.0, 1.0])[: len(axial), None]
    x, y, z = static.displacement
    return radial + x * np.sin(azimuth) + z * np.cos(azimuth), axial + outward * y


def _shift_of_cages(
    bearing: RollerBearing, arrangement: Arrangement, parameters: Parameters, static: StaticSolution
) -> Float:
    """Find how far outward the rollers take each cage, shape [row], [m].

    Through the end play they move further than their pockets allow. The cage goes no further than all of
    them ask; where no place suits them all, halfway between those that press hardest.
    """
    rows, pockets = arrangement.rows, parameters.effects.faults.pockets
    longer = 0.0 if pockets is None else arrangement.to_rollers(pockets[:, 1])
    room = 0.5 * bearing.cage.axial_clearance + longer
    shift = _places_in_cup(bearing, static)[1][:rows]
    least = np.max(shift - room, axis=1, where=arrangement.present, initial=-math.inf)
    most = np.min(shift + room, axis=1, where=arrangement.present, initial=math.inf)
    return np.where(least <= most, np.clip(0.0, least, most), 0.5 * (least + most))


def at_rest(rows: int, roller_count: int, modes: int) -> StaticSolution:
    """Make a bearing without load, for compiling only."""
    none = np.zeros((rows, roller_count))
    return StaticSolution(
        displacement=np.zeros(3), tilt=np.zeros(2), cup_load=none, cone_load=none, rib_load=none,
        cup_lamina_load=none[..., None], cone_lamina_load=none[..., None],
        roller_radial=none, roller_axial=none, roller_tilt=none, stiffness_tilt_held=np.zeros((3, 3)),
        stiffness_tilt_free=np.zeros((3, 3)), iterations=0, residual=0.0, bending=np.zeros(modes),
    )  # fmt: skip


def settle_lumped(
    bearing: RollerBearing,
    p: LumpedParameters,
    pose: Float,
    bent: Float,
    load: Float,
    modal_load: Float,
    cage_rate: float,
    restraint: Float,
) -> tuple[Float, Float]:
    """Find the pose of the cone and the bending of the box in the static equilibrium of the lumped tier.

    ``pose`` [5]: displacement and tilt about x and z to start from [m], [rad]; ``bent`` [mode]: amplitudes to
    start from [m sqrt(kg)]; ``load`` [5] or [3]: force on the cup and, with a free tilt, moment about x and z
    [N], [N m]; ``modal_load`` [mode]: what else but rollers pushes the modes [N/sqrt(kg)]; ``cage_rate``:
    [rad/s]; ``restraint`` [2]: stiffness of the suspension against tilt about x and z [N m/rad], without
    which nothing holds the tilt of a single row.

    Raises
    ------
    ValidityError
        When no equilibrium is found.
    """
    spring, cup = p.spring, p.base.cup
    counted = p.base.rollers[:, layout.MASK] > 0.0
    sides = np.broadcast_to(p.sides[0, 0], counted.shape)
    springs = np.zeros(len(load))
    springs[1] = p.base.mounting.prop_stiffness
    springs[3:] = restraint[: len(load) - 3]
    held, opening = len(load), np.zeros((*counted.shape, 0))
    if p.bending is not None:
        opening = openings_at_pockets(p.bending, p.base, len(np.unique(sides)))
        springs = np.concatenate([springs, p.bending.stiffness / p.bending.inverse])
        load = np.concatenate([load, modal_load])
    idle = spring.idle * p.kinematic.centrifugal * cage_rate**2
    rows, gaps, places, row_of = [], [], [], []
    for side in np.unique(sides):
        there = counted & (sides == side)
        azimuth, thicker = (
            p.base.rollers[:, layout.POCKET_ANGLE][there],
            p.base.rollers[:, layout.OVERSIZE][there],
        )
        order = np.argsort(azimuth)
        azimuth = azimuth[order]
        bends = opening[there][order]
        places.append(azimuth)
        row_of.append(np.full(azimuth.size, side))
        gaps.append(cup.gap - 2.0 * thicker[order])  # a thicker roller is pressed on both sides
        outward = np.stack([np.sin(azimuth), np.cos(azimuth)])
        lean = np.full(azimuth.size, -side * cup.sine)
        tilt_x, tilt_z = spring.lever * side * outward[1], -spring.lever * side * outward[0]
        pose_of = np.stack([cup.cosine * outward[0], lean, cup.cosine * outward[1], tilt_x, tilt_z], axis=1)
        rows.append(np.concatenate([pose_of[:, :held], -bends], axis=1))
    normal, gap = np.concatenate(rows), np.concatenate(gaps)
    tilts = normal[:, 3:held] / spring.lever  # how far the tilt of the cone tilts each roller's rings
    found = np.concatenate([pose[:held], bent])
    scale = np.array([1.0, 1.0, 1.0, spring.lever, spring.lever])[:held]
    # modes count as far as they open a raceway
    scale = np.concatenate([scale, np.maximum(np.sqrt((normal[:, held:] ** 2).mean(axis=0)), 1e-3)])
    terms = np.arange(len(spring.series))

    def missing_at(place: Float) -> tuple[Float, Float]:
        """Work out what load is not carried at a place, and the stiffness of what carries."""
        approach = normal @ place - gap
        root = np.maximum(approach, 1e-12) ** (1.0 / 9.0)
        pressing = approach > 0.0
        pressed = pressing * approach * root * (root[:, None] ** terms @ spring.series)
        tangent = 10.0 / 9.0 * pressed / np.maximum(approach, 1e-12) * (pressed > 0.5 * idle)
        force = np.maximum(pressed + 0.5 * idle, idle)
        stiffness = (normal * tangent[:, None]).T @ normal + np.diag(1e3 * scale**2 + springs)
        # what the lengths of the rollers hold of the tilt, `physics.tiers.massless_roller.add_length`
        turned, depth = tilts @ place[3:held], np.maximum(approach, 1e-12)
        lifted = np.maximum(np.abs(turned) * spring.reach / depth, 1.0)
        share = (1.0 - 17.0 / 27.0 / np.sqrt(lifted)) / lifted
        holding = spring.reach**2 * share * np.maximum(pressed - 0.5 * idle, 0.0) / depth
        lengths = (tilts * holding[:, None]).T @ tilts
        stiffness[3:held, 3:held] += lengths
        left = load - force @ normal - springs * place
        left[3:held] -= lengths @ place[3:held]
        if p.thrust is not None:
            whole = np.zeros(5)
            whole[: min(held, 5)] = place[: min(held, 5)]
            ribs = thrust_at(whole, np.concatenate(places), np.concatenate(row_of), approach, p.thrust)
            along = np.zeros_like(normal)
            along[:, :held] = ribs.by_pose[:, :held]
            ways = np.stack([along, normal])  # the way along the axle and the approach, in the unknowns
            left -= ribs.force @ along + ribs.pressing @ normal
            stiffness += np.einsum("irk,rij,jrl->kl", ways, ribs.tangent, ways)
        return left, stiffness

    missing, stiffness = missing_at(found)
    most = float(np.abs(load / scale).max())
    for _ in range(_ITERATIONS):
        size = float(np.abs(missing / scale).max())
        if size <= _TOLERANCE * max(most, 1.0):
            break
        change = np.linalg.solve(stiffness, missing)
        change *= min(1.0, 2e-5 / float(np.abs(change * scale).max()))
        # what carries stiffens as it gives way: a way that ends pushed back half as hard was too long
        pushed = float(missing @ change)
        for _ in range(_HALVINGS):
            missing, stiffness = missing_at(found + change)
            if float(missing @ change) >= -0.5 * pushed:
                break
            change, pushed = 0.5 * change, 0.5 * pushed
        found = found + change
    else:
        size = float(np.abs(missing / scale).max())
        if not size <= _ACCEPTABLE * most + _ACCEPTABLE_FORCE:
            raise ValidityError(
                f"the lumped tier found no static equilibrium under the first load in {_ITERATIONS} steps: "
                f"{size:.3g} N are left. Check load, {bearing.play_words} and preload; "
                f"{bearing.single_row_hint}; tier quasistatic finds its equilibrium by itself"
            )
    return np.concatenate([found[:held], pose[held:]]), found[held:]
