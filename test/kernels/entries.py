"""Small compiled entries around kernel parts: lane values come from and go to arrays [case, field, lane].

With ``NUMBA_DISABLE_JIT=1`` the same entries run as plain Python on NumPy arrays.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.base.jit import entry, inline
from beardyn_core.physics.bodies.contact_output import load_vector, store_vector
from beardyn_core.physics.bodies.friction_substeps import Held
from beardyn_core.physics.bodies.orbit import Body, View
from beardyn_core.physics.cage.pocket import Pocket, free_pocket
from beardyn_core.physics.cage.walls import Motion
from beardyn_core.physics.film import log2_entrainment, log2_film_thickness, log2_load
from beardyn_core.physics.generator_line import generator_line, line_slip
from beardyn_core.physics.lamina_coupling import DEPTH, FORCE, SURFACE, couple_laminae
from beardyn_core.physics.laminae import Raceway, lamina_sums
from beardyn_core.physics.lanes.lane_math import (
    arctangent_over,
    asinh_over,
    at_least,
    at_most,
    cos_sin,
    decay_over,
    exp2,
    floor,
    log2,
    log2_one_plus_exp2,
    magnitude,
    ninth_root,
    quick_ninth_root,
    sqrt,
    where_greater,
    wrap,
)
from beardyn_core.physics.lanes.solve import (
    add_line,
    add_line_everywhere,
    add_point,
    add_point_everywhere,
    solve,
)
from beardyn_core.physics.lanes.vectors import Wrench, subtract
from beardyn_core.physics.raceway import RacewayContact, push_raceway
from beardyn_core.physics.rib import push_rib, rib_contact
from beardyn_core.physics.rib_gap import rib_gap
from beardyn_core.physics.small_rib import push_small_rib, small_rib_contact
from beardyn_core.physics.traction import LaminaContact, friction_rate

MATH_NAMES = (
    "ninth_root", "log2", "exp2", "wrap", "cos", "sin", "sqrt", "magnitude", "floor", "at_least", "at_most",
    "where_greater", "negated", "quotient", "quick_ninth_root", "log2_one_plus_exp2",
)  # fmt: skip


@entry
def lane_math(lanes: Any, values: Any, out: Any, bound: Any) -> None:
    """All elementary functions of values [case, 1, lane] into out [case, len(MATH_NAMES), lane]."""
    for case in range(values.shape[0]):
        a = lanes.load(values, case, 0)
        cosine, sine = cos_sin(a)
        lanes.store(out, case, 0, ninth_root(a))
        lanes.store(out, case, 1, log2(a))
        lanes.store(out, case, 2, exp2(a))
        lanes.store(out, case, 3, wrap(a))
        lanes.store(out, case, 4, cosine)
        lanes.store(out, case, 5, sine)
        lanes.store(out, case, 6, sqrt(a))
        lanes.store(out, case, 7, magnitude(a))
        lanes.store(out, case, 8, floor(a))
        lanes.store(out, case, 9, at_least(a, bound))
        lanes.store(out, case, 10, at_most(a, bound))
        # the kernels' idiom: the other branch is made of the operand, so a NaN stays visible
        lanes.store(out, case, 11, where_greater(a, bound, 1.0 + 0.0 * a, 0.0 * a))
        lanes.store(out, case, 12, -a)
        lanes.store(out, case, 13, 1.0 / a)
        lanes.store(out, case, 14, quick_ninth_root(a))
        lanes.store(out, case, 15, log2_one_plus_exp2(a))


RACEWAY_OUTPUTS = 19  # force, moment, energy, approach (3), arm, arm slope, normal


@inline
def body_and_view(lanes: Any, states: Any, case: Any, orbit_rate: Any) -> Any:
    """Roller and ring of a case, inputs as of `raceways`; the ring stands at the origin."""
    body = Body(
        load_vector(lanes, states, case, 0),
        load_vector(lanes, states, case, 3),
        load_vector(lanes, states, case, 9),
        load_vector(lanes, states, case, 12),
        orbit_rate,
    )
    zero = lanes.constant(0.0)
    view = View(
        (zero, zero, zero),
        load_vector(lanes, states, case, 6),
        load_vector(lanes, states, case, 15),
        load_vector(lanes, states, case, 18),
    )
    return body, view


@inline
def pocket_of(lanes: Any, states: Any, case: Any, wear: Any, length: Any) -> Any:
    """Roller in its pocket of a case, inputs as of `raceways`, advance in the place of the oversize."""
    body, view = body_and_view(lanes, states, case, lanes.constant(0.0))
    motion = Motion(body.velocity, body.omega, view.velocity, view.omega)
    return Pocket(body.place, body.axis, motion, lanes.load(states, case, 21), view.axis, wear, length)


@inline
def store_walls(lanes: Any, out: Any, case: Any, walls: Any) -> None:
    """Force, moment and energy of a pocket."""
    store_vector(lanes, out, case, 0, walls.force)
    store_vector(lanes, out, case, 3, walls.moment)
    lanes.store(out, case, 6, walls.energy)


@entry
def raceways(lanes: Any, states: Any, out: Any, raceway: Any, ring: Any, speed: Any, p: Any) -> None:
    """Raceway contact of each case: wrench at the beginning of a step, energy and generator line."""
    for case in range(states.shape[0]):
        zero = lanes.constant(0.0)
        body, view = body_and_view(lanes, states, case, zero)
        centre, oversize = body.place, lanes.load(states, case, 21)
        line = generator_line(centre, body.axis, view.axis, oversize, raceway, p.roller)
        slip = line_slip(line, centre, body, view, None)
        log2_speed = log2_entrainment(lanes.constant(speed), p.effects.film)
        instant = (1e-12, 0.0)  # in so short a step no contact begins or ends
        held = Held(lanes, None, 0, False)
        shared = Raceway(
            lanes, ring, p.laminae, p.lamina_loads, 1.0, p.effects, (zero, zero), instant, held, None
        )
        sums = lamina_sums(shared, line, slip, log2_speed, False, None)
        level = Wrench((zero, zero, zero), (zero, zero, zero))
        contact = RacewayContact(line, slip, sums, level, log2_speed, centre, body, None, held, None)
        wrench = push_raceway(contact, p.effects.damping)
        store_vector(lanes, out, case, 0, wrench.force)
        store_vector(lanes, out, case, 3, wrench.moment)
        lanes.store(out, case, 6, sums.energy)
        store_vector(lanes, out, case, 7, line.approach)
        store_vector(lanes, out, case, 10, line.arm)
        store_vector(lanes, out, case, 13, line.arm_slope)
        store_vector(lanes, out, case, 16, line.normal)


@entry
def couplings(lanes: Any, depths: Any, out: Any, laminae: Any, coupling: Any) -> None:
    """Coupled laminae of each case at given penetrations: loads, then energies of the laminae."""
    count = laminae.shape[1]
    for case in range(depths.shape[0]):
        for k in range(count):
            lanes.store(coupling.work, DEPTH, k, lanes.load(depths, case, k))
        couple_laminae(lanes, laminae, coupling)
        for k in range(count):
            depth = at_least(lanes.load(depths, case, k), 0.0)
            lanes.store(out, case, k, 0.9 * depth * lanes.load(coupling.work, SURFACE, k))
            lanes.store(out, case, count + k, lanes.load(coupling.work, FORCE, k))


@entry
def ribs(lanes: Any, states: Any, out: Any, rib: Any, damping: Any) -> None:
    """Rib contact of each case (inputs as `raceways`, last the orbit rate): force, moment, energy, film."""
    for case in range(states.shape[0]):
        body, view = body_and_view(lanes, states, case, lanes.load(states, case, 21))
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        contact = rib_contact(body.place, body, view, rib, damping)
        wrench = push_rib(Wrench(nothing, nothing), contact, rib)
        store_vector(lanes, out, case, 0, wrench.force)
        store_vector(lanes, out, case, 3, wrench.moment)
        lanes.store(out, case, 6, contact.first.energy + contact.second.energy)
        lanes.store(out, case, 7, contact.first.film)


@entry
def rib_gaps(lanes: Any, states: Any, out: Any, rib: Any) -> None:
    """Rib gap of each case (inputs as `raceways`): depth, normal, arm."""
    for case in range(states.shape[0]):
        depth, normal, arm = rib_gap(
            load_vector(lanes, states, case, 0),
            load_vector(lanes, states, case, 3),
            load_vector(lanes, states, case, 6),
            rib,
            rib.window,
            rib.end,
        )
        lanes.store(out, case, 0, depth)
        store_vector(lanes, out, case, 1, normal)
        store_vector(lanes, out, case, 4, arm)


@entry
def small_ribs(lanes: Any, states: Any, out: Any, rib: Any) -> None:
    """Small-rib contact of each case (inputs as `raceways`): force, moment, energy."""
    for case in range(states.shape[0]):
        body, view = body_and_view(lanes, states, case, lanes.constant(0.0))
        contact = small_rib_contact(body.place, body, view, rib)
        nothing = subtract(body.place, body.place)
        wrench = push_small_rib(Wrench(nothing, nothing), contact, rib)
        store_vector(lanes, out, case, 0, wrench.force)
        store_vector(lanes, out, case, 3, wrench.moment)
        lanes.store(out, case, 6, contact.energy)


@entry
def pockets(lanes: Any, states: Any, out: Any, roller: Any, cage: Any) -> None:
    """Pocket contact of each case (inputs as `raceways`, advance in the place of the oversize)."""
    for case in range(states.shape[0]):
        pocket = pocket_of(lanes, states, case, lanes.constant(0.0), lanes.constant(0.0))
        store_walls(lanes, out, case, free_pocket(pocket, roller, cage).walls)


@entry
def solves(lanes: Any, systems: Any, out: Any) -> None:
    """Solve systems [case, 21 + 6, lane] into out [case, 6, lane]."""
    for case in range(systems.shape[0]):
        matrix = (
            lanes.load(systems, case, 0), lanes.load(systems, case, 1), lanes.load(systems, case, 2),
            lanes.load(systems, case, 3), lanes.load(systems, case, 4), lanes.load(systems, case, 5),
            lanes.load(systems, case, 6), lanes.load(systems, case, 7), lanes.load(systems, case, 8),
            lanes.load(systems, case, 9), lanes.load(systems, case, 10), lanes.load(systems, case, 11),
            lanes.load(systems, case, 12), lanes.load(systems, case, 13), lanes.load(systems, case, 14),
            lanes.load(systems, case, 15), lanes.load(systems, case, 16), lanes.load(systems, case, 17),
            lanes.load(systems, case, 18), lanes.load(systems, case, 19), lanes.load(systems, case, 20),
        )  # fmt: skip
        right = (
            lanes.load(systems, case, 21), lanes.load(systems, case, 22), lanes.load(systems, case, 23),
            lanes.load(systems, case, 24), lanes.load(systems, case, 25), lanes.load(systems, case, 26),
        )  # fmt: skip
        change = solve(matrix, right)
        store_vector(lanes, out, case, 0, change.velocity)
        store_vector(lanes, out, case, 3, change.omega)


@entry
def contact_matrices(lanes: Any, cases: Any, out: Any) -> None:
    """A line and a point contact added to a zero matrix, in one direction and then in every direction.

    Inputs: direction, arm, arm slope, three weights; outputs: 21 entries each.
    """
    for case in range(cases.shape[0]):
        zero = lanes.constant(0.0)
        empty = (
            zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero,
            zero, zero, zero, zero, zero,
        )  # fmt: skip
        direction = load_vector(lanes, cases, case, 0)
        arm = load_vector(lanes, cases, case, 3)
        slope = load_vector(lanes, cases, case, 6)
        weights = load_vector(lanes, cases, case, 9)
        line = add_line(empty, direction, arm, slope, weights)
        point = add_point(empty, direction, arm, weights[0])
        for i in range(7):
            store_vector(lanes, out, case, 3 * i, (line[3 * i], line[3 * i + 1], line[3 * i + 2]))
            store_vector(lanes, out, case, 21 + 3 * i, (point[3 * i], point[3 * i + 1], point[3 * i + 2]))
        line = add_line_everywhere(empty, arm, slope, weights)
        point = add_point_everywhere(empty, arm, weights[0])
        for i in range(7):
            store_vector(lanes, out, case, 42 + 3 * i, (line[3 * i], line[3 * i + 1], line[3 * i + 2]))
            store_vector(lanes, out, case, 63 + 3 * i, (point[3 * i], point[3 * i + 1], point[3 * i + 2]))


@entry
def frictions(lanes: Any, cases: Any, out: Any, lamina: Any, ring: Any, p: Any) -> None:
    """Film thickness (log2) and friction rate: inputs load, slip squared, entrainment speed."""
    for case in range(cases.shape[0]):
        load = lanes.load(cases, case, 0)
        log2_speed = log2_entrainment(lanes.load(cases, case, 2), p.effects.film)
        force = log2_load(load)
        thickness = log2_film_thickness(force, log2_speed, lamina, ring, p.laminae, p.effects.film)
        square = lanes.load(cases, case, 1)
        contact = LaminaContact(load, force, square, thickness, log2_speed[1], lamina, ring, p.laminae)
        rate = friction_rate(contact, p.effects)
        lanes.store(out, case, 0, thickness + lanes.constant(0.0))
        lanes.store(out, case, 1, rate + lanes.constant(0.0))


@entry
def saturations(lanes: Any, values: Any, out: Any) -> None:
    """(1 - exp(-x)) / x, asinh(x) / x and atan(x) / x of values [case, 1, lane]."""
    for case in range(values.shape[0]):
        x = lanes.load(values, case, 0)
        lanes.store(out, case, 0, decay_over(x))
        lanes.store(out, case, 1, asinh_over(x))
        lanes.store(out, case, 2, arctangent_over(x))
