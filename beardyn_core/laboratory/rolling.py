"""A coin and a roller of several circles in a cylindrical trough, with the general search in every step.

Six degrees of freedom. Each circle is searched for its contact with the floor (surface-line, three unknowns)
from where it was a stage before; Kelvin-Voigt normal force that never pulls, Threlfall friction. Losses are
integrated with the motion, so that the energy balance has to close.

References
----------
Threlfall, D. C. (1978), The inclusion of Coulomb friction in mechanisms programs with particular reference
to DRAM, Mechanism and Machine Theory 13, 475-483: mu (1 - exp(-3 v / v_r)) up to v_r.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.laboratory.compiled import WORK_NUMBERS, solve_pair
from beardyn_core.laboratory.search import SURFACE_LINE
from beardyn_core.laboratory.shapes import Cone, Placement

GRAVITY = 9.81
# columns of the state: place, attitude (w, x, y, z), velocity, angular velocity (body axes), losses
PLACE, ATTITUDE, VELOCITY, SPIN, DAMPED, RUBBED, STATES = 0, 3, 7, 10, 13, 14, 15
# columns of the history after the state
ELASTIC, DEEPEST, FIRST_CONTACT = STATES, STATES + 1, STATES + 2
_FULL_FRICTION = 1.0 - math.exp(-3.0)


@dataclass(frozen=True)
class RollingBody:
    """A body of revolution that touches with circles."""

    name: str
    radius: A[float, "of its circles, [m]"]
    thickness: A[float, "overall, [m]"]
    circles: A[int, "circles evenly along the thickness"]
    density: A[float, "[kg/m^3]"] = 7800.0

    @property
    def mass(self) -> float:
        """[kg]."""
        return math.pi * self.radius**2 * self.thickness * self.density

    @property
    def axial_inertia(self) -> float:
        """[kg m^2]."""
        return 0.5 * self.mass * self.radius**2

    @property
    def transverse_inertia(self) -> float:
        """[kg m^2]."""
        return self.mass * (3.0 * self.radius**2 + self.thickness**2) / 12.0

    @property
    def places(self) -> Float:
        """Of the circles along the axis, shape [circle], [m]."""
        return ((np.arange(self.circles) + 0.5) / self.circles - 0.5) * self.thickness


@dataclass(frozen=True)
class Trough:
    """Cylindrical floor with a horizontal axis, and the contact laws."""

    radius: A[float, "[m]"] = 0.3
    stiffness: A[float, "of the whole body's contact, shared by its circles, [N/m]"] = 2.0e6
    damping: A[float, "of the whole body's contact, shared by its circles, [N s/m]"] = 200.0
    friction: float = 0.25
    transition_speed: A[float, "v_r of Threlfall's law, [m/s]"] = 2.0e-3

    def floor(self) -> Cone:
        """Build the floor: axis along z, body outside; its sweep angle starts at the lowest line."""
        east, north, pole = np.array([0.0, -1.0, 0.0]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
        return Cone(Placement(np.zeros(3), east, north, pole), self.radius, 0.0, -1.0)


COIN = RollingBody("coin, one circle", radius=0.0125, thickness=0.002, circles=1)
ROLLER = RollingBody("roller, six circles", radius=0.0133, thickness=0.05, circles=6)
START_ANGLE = math.radians(30.0)  # rolling without sliding takes tan(30 deg) / 3 = 0.19 of friction there
STEP = 1.0e-5  # [s]


@inline
def _rotation_matrix(q: Any, v0: Any, v1: Any, v2: Any) -> Any:
    """Return the matrix from body axes to world axes."""
    w, x, y, z = q
    t0, t1, t2 = 2.0 * (y * v2 - z * v1), 2.0 * (z * v0 - x * v2), 2.0 * (x * v1 - y * v0)
    return v0 + w * t0 + y * t2 - z * t1, v1 + w * t1 + z * t0 - x * t2, v2 + w * t2 + x * t1 - y * t0


@inline
def _rates(
    s: Any, body: Any, places: Any, floor: Any, laws: Any, form: Any, circle: Any, x: Any, w: Any, r: Any
) -> Any:
    """Write the derivative of the state to ``r``; return energy, deepest penetration, failures."""
    mass, axial, transverse, radius = body[0], body[1], body[2], body[3]
    q = (s[3], s[4], s[5], s[6])
    ex = _rotation_matrix(q, 1.0, 0.0, 0.0)
    ey = _rotation_matrix(q, 0.0, 1.0, 0.0)
    ez = _rotation_matrix(q, 0.0, 0.0, 1.0)
    spin = _rotation_matrix(q, s[10], s[11], s[12])
    force0, force1, force2 = 0.0, -mass * GRAVITY, 0.0
    torque0, torque1, torque2 = 0.0, 0.0, 0.0
    damped, rubbed, elastic, deepest, failed = 0.0, 0.0, 0.0, 0.0, 0
    count = len(places)
    stiffness, damping = laws[0] / count, laws[1] / count
    circle[0], circle[1], circle[2], circle[3] = 2.0, radius, 0.0, 1.0
    for i in range(3):
        circle[7 + i], circle[10 + i], circle[13 + i] = ex[i], ey[i], ez[i]
    for k in range(count):
        for i in range(3):
            circle[4 + i] = s[i] + places[k] * ez[i]
        if solve_pair(circle, floor, 1, form, 3, True, x[k], w) < 0:
            failed += 1
            continue
        n0, n1, n2 = w[18], w[19], w[20]
        gap = w[0] * n0 + w[1] * n1 + w[2] * n2
        if not gap < 0.0:
            continue
        # point of the circle from the centre: its radial direction is the normal of the line
        a0 = places[k] * ez[0] + radius * w[9]
        a1 = places[k] * ez[1] + radius * w[10]
        a2 = places[k] * ez[2] + radius * w[11]
        v0 = s[7] + spin[1] * a2 - spin[2] * a1
        v1 = s[8] + spin[2] * a0 - spin[0] * a2
        v2 = s[9] + spin[0] * a1 - spin[1] * a0
        opening = v0 * n0 + v1 * n1 + v2 * n2
        spring = -stiffness * gap
        load = max(spring - damping * opening, 0.0)
        u0, u1, u2 = v0 - opening * n0, v1 - opening * n1, v2 - opening * n2
        speed = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        rub = 0.0
        if speed > 1e-15:
            share = speed / laws[3]
            level = 1.0 - math.exp(-3.0 * share) if share < 1.0 else _FULL_FRICTION
            rub = laws[2] * load * level / speed
        f0, f1, f2 = load * n0 - rub * u0, load * n1 - rub * u1, load * n2 - rub * u2
        force0, force1, force2 = force0 + f0, force1 + f1, force2 + f2
        torque0 += a1 * f2 - a2 * f1
        torque1 += a2 * f0 - a0 * f2
        torque2 += a0 * f1 - a1 * f0
        damped += (spring - load) * opening
        rubbed += rub * speed * speed
        elastic += 0.5 * spring * -gap
        deepest = max(deepest, -gap)
    for i in range(3):
        r[i] = s[7 + i]
    p0, p1, p2 = s[10], s[11], s[12]
    r[3] = -0.5 * (q[1] * p0 + q[2] * p1 + q[3] * p2)
    r[4] = 0.5 * (q[0] * p0 + q[2] * p2 - q[3] * p1)
    r[5] = 0.5 * (q[0] * p1 + q[3] * p0 - q[1] * p2)
    r[6] = 0.5 * (q[0] * p2 + q[1] * p1 - q[2] * p0)
    r[7], r[8], r[9] = force0 / mass, force1 / mass, force2 / mass
    m0 = torque0 * ex[0] + torque1 * ex[1] + torque2 * ex[2]
    m1 = torque0 * ey[0] + torque1 * ey[1] + torque2 * ey[2]
    m2 = torque0 * ez[0] + torque1 * ez[1] + torque2 * ez[2]
    r[10] = (m0 - (axial - transverse) * p1 * p2) / transverse
    r[11] = (m1 - (transverse - axial) * p2 * p0) / transverse
    r[12] = m2 / axial
    r[13], r[14] = damped, rubbed
    return elastic, deepest, failed


@partial(entry, allocates=True)
def roll(
    state: Any,
    body: Any,
    places: Any,
    floor: Any,
    laws: Any,
    form: Any,
    x: Any,
    step: Any,
    every: Any,
    out: Any,
) -> Any:
    """Make Runge-Kutta steps, write state, energies, contacts at every so many; count failed searches."""
    w, circle = np.zeros(WORK_NUMBERS), np.zeros(16)
    r1, r2, r3, r4 = np.zeros(STATES), np.zeros(STATES), np.zeros(STATES), np.zeros(STATES)
    moved = np.zeros(STATES)
    failed = 0
    for sample in range(len(out)):
        for sub in range(every):
            elastic, deepest, lost = _rates(state, body, places, floor, laws, form, circle, x, w, r1)
            failed += lost
            if sub == 0:
                out[sample, :STATES] = state
                out[sample, ELASTIC], out[sample, DEEPEST] = elastic, deepest
                for k in range(len(places)):
                    out[sample, FIRST_CONTACT + 3 * k : FIRST_CONTACT + 3 * k + 3] = x[k, :3]
            for i in range(STATES):
                moved[i] = state[i] + 0.5 * step * r1[i]
            failed += _rates(moved, body, places, floor, laws, form, circle, x, w, r2)[2]
            for i in range(STATES):
                moved[i] = state[i] + 0.5 * step * r2[i]
            failed += _rates(moved, body, places, floor, laws, form, circle, x, w, r3)[2]
            for i in range(STATES):
                moved[i] = state[i] + step * r3[i]
            failed += _rates(moved, body, places, floor, laws, form, circle, x, w, r4)[2]
            for i in range(STATES):
                state[i] += step / 6.0 * (r1[i] + 2.0 * r2[i] + 2.0 * r3[i] + r4[i])
            norm = math.sqrt(state[3] ** 2 + state[4] ** 2 + state[5] ** 2 + state[6] ** 2)
            state[3:7] /= norm
    return failed


@dataclass(frozen=True)
class Rolling:
    """What a body did in the trough."""

    body: RollingBody
    trough: Trough
    time: A[Float, "shape [sample], [s]"]
    history: A[Float, "[sample, column]: state, elastic energy, deepest penetration, parameters of contacts"]
    failed_searches: int
    searches: int

    @property
    def height(self) -> Float:
        """Of the centre over its lowest place, shape [sample], [m]."""
        return self.history[:, PLACE + 1] + self.trough.radius - self.body.radius

    @property
    def energies(self) -> dict[str, Float]:
        """Kinetic, potential, elastic, and lost by damping and friction, shape [sample] each, [J]."""
        body, history = self.body, self.history
        velocity, spin = history[:, VELOCITY : VELOCITY + 3], history[:, SPIN : SPIN + 3]
        kinetic = 0.5 * body.mass * (velocity**2).sum(axis=1)
        kinetic += 0.5 * body.transverse_inertia * (spin[:, :2] ** 2).sum(axis=1)
        kinetic += 0.5 * body.axial_inertia * spin[:, 2] ** 2
        return {
            "kinetic": kinetic,
            "potential": body.mass * GRAVITY * self.height,
            "elastic": history[:, ELASTIC],
            "damping": history[:, DAMPED],
            "friction": history[:, RUBBED],
        }

    @property
    def residual(self) -> Float:
        """What the energy balance leaves, shape [sample], [J]."""
        total = sum(self.energies.values())
        assert isinstance(total, np.ndarray)
        return total - total[0]

    @property
    def turning_sample(self) -> int:
        """Sample of the first turning point on the other side."""
        moving = self.history[:, VELOCITY]
        beyond = np.flatnonzero((moving <= 0.0) & (self.history[:, PLACE] > 0.0))
        return int(beyond[0]) if beyond.size else len(self.time) - 1

    @property
    def lean(self) -> Float:
        """Angle of the body's axis to the trough's, shape [sample], [rad]."""
        x, y = self.history[:, ATTITUDE + 1], self.history[:, ATTITUDE + 2]
        return 2.0 * np.arcsin(np.minimum(np.sqrt(x**2 + y**2), 1.0))


def run_rolling(
    body: RollingBody,
    trough: Trough | None = None,
    *,
    duration: float = 1.5,
    step: float = STEP,
    start_angle: float = START_ANGLE,
    interval: float = 2.0e-3,
) -> Rolling:
    """Release a body at rest on the slope, just touching, and let it roll.

    Parameters
    ----------
    body : RollingBody
    trough : Trough, optional
    duration, step, interval : float
        Simulated, of a step, and between the samples kept, [s].
    start_angle : float
        Of its place from the lowest line, towards -x, [rad].
    """
    trough = trough or Trough()
    every = max(1, round(interval / step))
    samples = max(2, round(duration / (every * step)))
    reach = trough.radius - body.radius
    state = np.zeros(STATES)
    state[:2] = -reach * math.sin(start_angle), -reach * math.cos(start_angle)
    state[ATTITUDE] = 1.0
    # angle of the circle from x, height and sweep angle of the floor from the lowest line
    x = np.zeros((body.circles, 4))
    x[:, 0] = -0.5 * math.pi - start_angle
    x[:, 1], x[:, 2] = body.places, -start_angle
    out = np.zeros((samples, FIRST_CONTACT + 3 * body.circles))
    failed = roll(
        state,
        np.array([body.mass, body.axial_inertia, body.transverse_inertia, body.radius]),
        body.places,
        trough.floor().encode(),
        np.array([trough.stiffness, trough.damping, trough.friction, trough.transition_speed]),
        SURFACE_LINE.encode(),
        x,
        step,
        every,
        out,
    )
    time = np.arange(samples, dtype=np.float64) * (every * step)
    return Rolling(body, trough, time, out, int(failed), 4 * samples * every * body.circles)
