"""Slow, obvious references of the kernels: NumPy and SciPy, one lamina and one formula at a time.

Everything is written in a ring's right-handed frame (first axis radial at azimuth 0, third axis the ring's
outward axis) or, for a whole step, in Cartesian coordinates of that frame. Nothing here is imported from
the kernels; parameters are the kernels' named tuples.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, minimize_scalar

from beardyn_core.effects import LineFilm
from beardyn_core.effects.grease import LAYERS

Float = NDArray[np.float64]


# --- geometry of one contact


def cone_field(point: Float, ring_axis: Float, apex: float, raceway: Any) -> float:
    """How far a point (from the ring's origin) is inside the raceway's material, exact, [m]."""
    from_apex = point - apex * ring_axis
    along = float(from_apex @ ring_axis)
    radial = float(np.linalg.norm(from_apex - along * ring_axis))
    return float(raceway.side) * (radial * raceway.cosine - along * raceway.sine) - float(raceway.gap)


def cone_normal(point: Float, ring_axis: Float, apex: float, raceway: Any) -> Float:
    """Unit normal into the raceway's material: the gradient of `cone_field`."""
    from_apex = point - apex * ring_axis
    across = from_apex - (from_apex @ ring_axis) * ring_axis
    outward = across / np.linalg.norm(across)
    normal: Float = raceway.side * (raceway.cosine * outward - raceway.sine * ring_axis)
    return normal


def deepest_rim_point(
    disc: Float, axis: Float, radius: float, ring_axis: Float, apex: float, raceway: Any
) -> tuple[float, Float]:
    """Penetration and place of the deepest point of a disc's rim, by brute-force search."""
    first = np.cross(axis, [0.3, -0.8, 0.2])
    first /= np.linalg.norm(first)
    second = np.cross(axis, first)

    def rim(angle: float) -> Float:
        return disc + radius * (math.cos(angle) * first + math.sin(angle) * second)

    angles = np.linspace(-np.pi, np.pi, 73)
    start = max(angles, key=lambda angle: cone_field(rim(angle), ring_axis, apex, raceway))
    spread = angles[1] - angles[0]
    found = minimize_scalar(
        lambda turn: -cone_field(rim(start + turn), ring_axis, apex, raceway),
        bounds=(-spread, spread),
        method="bounded",
        options={"xatol": 1e-11},
    )
    point = rim(start + found.x)
    return cone_field(point, ring_axis, apex, raceway), point


def closed_form_point(
    disc: Float, axis: Float, radius: float, ring_axis: Float, apex: float, raceway: Any, passes: int = 2
) -> Float:
    """Contact point of a disc by the closed form, the normal taken at the last point found."""
    at = disc
    for _ in range(passes):
        normal = cone_normal(at, ring_axis, apex, raceway)
        edge = normal - (normal @ axis) * axis
        at = disc + radius * edge / np.linalg.norm(edge)
    return at


# --- force laws of one lamina


def line_force(stiffness: float, depth: float) -> float:
    """Palmgren: Q = K delta^(10/9)."""
    return stiffness * depth ** (10.0 / 9.0) if depth > 0.0 else 0.0


def line_tangent(stiffness: float, depth: float) -> float:
    """Derivative of `line_force`."""
    return 10.0 / 9.0 * stiffness * depth ** (1.0 / 9.0) if depth > 0.0 else 0.0


def line_energy(stiffness: float, depth: float) -> float:
    """Integral of `line_force`."""
    return 9.0 / 19.0 * stiffness * depth ** (19.0 / 9.0) if depth > 0.0 else 0.0


def coulomb_friction(load: float, slip: float, friction: float, regularisation: float) -> float:
    """Friction force at a slip speed."""
    return friction * load * slip / math.hypot(slip, regularisation)


def blend_weight(film_parameter: float, boundary: float, full: float) -> float:
    """Share of boundary friction, Eq. 8 of the seed as physics.md prints it."""
    if film_parameter <= boundary:
        return 1.0
    if film_parameter >= full:
        return 0.0
    return ((film_parameter - full) / (boundary - full)) ** 6


def sheared_film_friction(
    load: float, slip: float, thickness: float, mean_pressure: float, limiting_shear: float, film: Any
) -> float:
    """Newtonian stress eta u / h of the piezo-viscous oil, limited smoothly at limiting_shear x p, on the
    Hertz area load / p."""
    viscosity = film.viscosity * math.exp(min(film.pressure_viscosity * mean_pressure, 30.0 * math.log(2.0)))
    newton = viscosity * slip / thickness
    limit = limiting_shear * mean_pressure
    return newton * limit / math.hypot(newton, limit) * load / mean_pressure


def mixed_friction(
    load: float, slip: float, thickness: float, mean_pressure: float, mixed: Any, film: Any
) -> float:
    """Friction force of a lamina: boundary and full-film parts blended over the film parameter."""
    if load <= 0.0:
        return 0.0
    if mixed.sheared_film is None:
        wet = coulomb_friction(load, slip, mixed.film_friction, mixed.regularisation)
    else:
        shear = mixed.sheared_film.limiting_shear
        wet = sheared_film_friction(load, slip, thickness, mean_pressure, shear, film)
    boundary = coulomb_friction(load, slip, mixed.friction, mixed.regularisation)
    weight = blend_weight(thickness / film.roughness, mixed.boundary_film, mixed.full_film)
    return weight * boundary + (1.0 - weight) * wet


def mean_hertz_pressure(load: float, length: float, radius: float, contact_modulus: float) -> float:
    """pi/4 of the largest pressure of a line contact, p0 = sqrt(q E* / (pi R)), E* = E'/2."""
    return math.pi / 4.0 * math.sqrt(load / length * 0.5 * contact_modulus / (math.pi * radius))


def film_thickness(load: float, speed: float, lamina: Any) -> float:
    """Dowson and Higginson at one lamina, every group spelled out, [m]."""
    e_prime, radius = lamina.contact_modulus, lamina.radius
    u = lamina.viscosity * speed / (e_prime * radius)
    g = lamina.pressure_viscosity * e_prime
    w = load / lamina.length / (e_prime * radius)
    return left_of_film(2.65 * u**0.7 * g**0.54 / w**0.13 * radius, lamina.viscosity * speed, lamina.options)


def left_of_film(flooded: float, viscosity_times_speed: float, options: LineFilm) -> float:
    """What lack of oil leaves of a film: a constant share, or by the layer of oil on the raceways."""
    if options.starvation is not None:
        return options.starvation * flooded
    layer = options.layer if options.layer is not None else LAYERS[options.supply]
    if layer is None:
        return flooded
    layer *= (viscosity_times_speed / 0.15) ** 0.3
    r = layer / flooded
    return float(flooded * r / (1.0 + r**4) ** 0.25)


@dataclass(frozen=True)
class FilmLamina:
    """Numbers of one lamina for the film and the fluid friction."""

    length: float
    radius: float
    contact_modulus: float
    viscosity: float
    pressure_viscosity: float
    options: LineFilm


# --- whole contacts: wrench on the roller about its centre of mass


@dataclass(frozen=True)
class Motion:
    """Roller and ring as one contact sees them: vectors from the ring's origin."""

    centre: Float
    axis: Float
    velocity: Float
    omega: Float
    ring_axis: Float
    ring_velocity: Float
    ring_omega: Float

    def slip(self, point: Float) -> Float:
        """Velocity of the roller against the ring at a point."""
        roller = self.velocity + np.cross(self.omega, point - self.centre)
        ring = self.ring_velocity + np.cross(self.ring_omega, point)
        difference: Float = roller - ring
        return difference


@dataclass
class Wrench:
    """Force and moment about the centre of mass, elastic energy, implicit resistance (6 x 6)."""

    force: Float
    moment: Float
    energy: float
    resistance: Float

    @staticmethod
    def none() -> Wrench:
        return Wrench(np.zeros(3), np.zeros(3), 0.0, np.zeros((6, 6)))

    def push(self, force: Float, arm: Float) -> None:
        self.force = self.force + force
        self.moment = self.moment + np.cross(arm, force)

    def resist(self, direction: Float, arm: Float, weight: float) -> None:
        row = np.concatenate([direction, np.cross(arm, direction)])
        self.resistance = self.resistance + weight * np.outer(row, row)


def raceway_wrench(
    motion: Motion,
    raceway: Any,
    roller: Any,
    laminae: Float,
    *,
    friction: Any = None,
    damping_time: float = 0.0,
    spring_time: float = 0.0,
    step: float = 0.0,
    oversize: float = 0.0,
    exact_search: bool = False,
) -> Wrench:
    """Laminae one by one, each at its own contact point with its own normal.

    ``friction(k, load, slip_speed)`` is the friction force of lamina k; ``laminae`` the kernels' table.
    """
    total = Wrench.none()
    for k in range(laminae.shape[1]):
        x, drop, stiffness = laminae[0, k], laminae[1, k], laminae[2, k]
        disc = motion.centre + x * motion.axis
        radius = roller.radius + x * roller.taper + oversize
        where = (disc, motion.axis, radius, motion.ring_axis, roller.apex, raceway)
        point = deepest_rim_point(*where)[1] if exact_search else closed_form_point(*where)
        depth = cone_field(point, motion.ring_axis, roller.apex, raceway) - drop
        if depth <= 0.0:
            continue
        normal = cone_normal(point, motion.ring_axis, roller.apex, raceway)
        arm = point - motion.centre
        slip = motion.slip(point)
        rate = float(slip @ normal)
        tangent = line_tangent(stiffness, depth)
        total.energy += line_energy(stiffness, depth)
        load = line_force(stiffness, depth) + damping_time * tangent * rate
        if depth < abs(rate) * step:  # the contact begins or ends within the step
            missing = max(0.5 - 3.0 * spring_time / step, 0.0) * (1.0 - depth / (abs(rate) * step))
            load -= missing * line_force(stiffness, depth)
        if load <= 0.0:
            continue
        total.push(-load * normal, arm)
        total.resist(normal, arm, (spring_time + 0.5 * damping_time) * tangent)
        if friction is None:
            continue
        sliding = slip - rate * normal
        speed = float(np.linalg.norm(sliding))
        per_speed = friction(k, load, max(speed, 1e-12)) / max(speed, 1e-12)
        total.push(-per_speed * sliding, arm)
        around = np.cross(motion.ring_axis, normal)
        around /= np.linalg.norm(around)
        total.resist(around, arm, per_speed)
        total.resist(np.cross(normal, around), arm, per_speed)
    return total


def rib_depth_by_search(centre: Float, axis: Float, ring_axis: Float, rib: Any) -> float:
    """Deepest point of the end sphere behind the conical rib, by search over the sphere."""
    sphere = centre + rib.sphere_place * axis

    def inside(angles: Float) -> float:
        polar, turn = angles
        direction = np.array(
            [math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn), math.cos(polar)]
        )
        point = sphere + rib.sphere_radius * direction
        along = float(point @ ring_axis)
        radial = float(np.linalg.norm(point - along * ring_axis))
        return along * rib.normal_axial + radial * rib.normal_radial - rib.distance

    found = minimize(
        lambda angles: -1e6 * inside(angles),
        x0=[math.atan2(rib.normal_radial, rib.normal_axial), math.atan2(centre[1], centre[0])],
        method="Nelder-Mead",
        options={"xatol": 1e-12, "fatol": 1e-9, "maxiter": 4000, "maxfev": 4000},
    )
    return -1e-6 * float(found.fun)


def rib_wrench(motion: Motion, rib: Any, *, damping_time: float = 0.0, spring_time: float = 0.0) -> Wrench:
    """Sphere against cone: the sphere's deepest point lies on the cone normal through its centre."""
    total = Wrench.none()
    sphere = motion.centre + rib.sphere_place * motion.axis
    along = float(sphere @ motion.ring_axis)
    across = sphere - along * motion.ring_axis
    outward = across / np.linalg.norm(across)
    normal = rib.normal_axial * motion.ring_axis + rib.normal_radial * outward
    point = sphere + rib.sphere_radius * normal
    reach = point - (point @ motion.ring_axis) * motion.ring_axis
    depth = float(point @ motion.ring_axis) * rib.normal_axial
    depth += float(np.linalg.norm(reach)) * rib.normal_radial - rib.distance
    if depth <= 0.0:
        return total
    total.energy = rib.stiffness * depth**2.5 / 2.5
    tangent = 1.5 * rib.stiffness * math.sqrt(depth)
    arm = point - motion.centre
    slip = motion.slip(point)
    rate = float(slip @ normal)
    load = rib.stiffness * depth**1.5 + damping_time * tangent * rate
    if load <= 0.0:
        return total
    sliding = slip - rate * normal
    speed = float(np.linalg.norm(sliding))
    per_speed = coulomb_friction(load, 1.0, rib.friction, 0.0) / math.hypot(speed, rib.regularisation)
    total.push(-load * normal - per_speed * sliding, arm)
    total.resist(normal, arm, (spring_time + 0.5 * damping_time) * tangent)
    around = np.cross(motion.ring_axis, normal)
    around /= np.linalg.norm(around)
    total.resist(around, arm, per_speed)
    total.resist(np.cross(normal, around), arm, per_speed)
    return total


def pocket_wrench(
    motion: Motion, tilt: Float, advance: float, azimuth: float, roller: Any, cage: Any
) -> Wrench:
    """Roller against the five walls of its pocket: planes that stand off the nominal roller by the play.

    ``motion`` is in the ring frame; the pocket stands at ``azimuth - advance``.
    """
    total = Wrench.none()
    at = azimuth - advance
    third = np.array([0.0, 0.0, 1.0])

    def tilted(vector: Float) -> Float:
        turned: Float = vector + np.cross(tilt, vector)
        return turned

    outward = tilted(np.array([math.cos(at), math.sin(at), 0.0]))
    ahead = tilted(np.array([-math.sin(at), math.cos(at), 0.0]))
    plain = np.array([math.cos(at), math.sin(at), 0.0])
    pocket_axis = tilted(cage.axis_radial * plain + cage.axis_axial * third)
    walls = []
    for sense in (1.0, -1.0):
        normal = sense * cage.bar_cosine * ahead + cage.bar_sine * outward
        for x in (-cage.bar_place, cage.bar_place):
            # the nominal disc at x, its centre `height` out; its play along the normal is measured ahead
            radius = roller.radius + x * roller.taper
            disc = motion.centre + x * motion.axis
            height = cage.roller_height + x * cage.axis_radial
            across = cage.bar_sine * (float(outward @ disc) - height)
            offset = sense * cage.bar_cosine * float(ahead @ disc)
            depth = across + offset - cage.bar_cosine * cage.half_clearance
            walls.append((normal, x * motion.axis + radius * normal, depth))
    side = 1.0 if float(pocket_axis @ motion.centre) > cage.roller_place else -1.0
    end = side * roller.half_length * motion.axis
    nominal = cage.roller_place + side * roller.half_length
    stands_in = side * (float(pocket_axis @ (motion.centre + end)) - nominal)
    walls.append((side * pocket_axis, end, stands_in - cage.half_end_clearance))
    for normal, arm, depth in walls:
        if depth <= 0.0:
            continue
        slip = motion.slip(motion.centre + arm)
        rate = float(slip @ normal)
        # a contact that begins or ends within the step: exact work in the mean of its two ends
        way = max(abs(rate) * cage.step, 1e-15)
        pressed = depth if depth >= way else 0.5 * depth * (1.0 + depth / way)
        load = max(cage.stiffness * pressed + cage.damping * rate, 0.0)
        sliding = slip - rate * normal
        per_speed = cage.friction * load / math.hypot(float(np.linalg.norm(sliding)), cage.regularisation)
        total.push(-load * normal - per_speed * sliding, arm)
        total.energy += 0.5 * cage.stiffness * depth**2
    return total
