"""One roller between two raceways, stepped explicitly: finite, right in the mean, and not stable.

A roller of mass m and inertia J is pressed with N between a cup at rest and a cone that moves with V, both
plane here, and a cage pulls it back a little. Friction is mu N u / sqrt(u^2 + u_r^2); near rolling that is a
damper c = mu N / u_r, so the slips decay at 2 c / m and 2 c r^2 / J, and an explicit step longer than
2 / rate cannot follow. It does not grow without end, for friction saturates: it settles in a cycle of two
steps, +f and -f, whose mean is right. Whoever looks at every second step sees a calm run.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.physics.bodies.layout import (
    BODY_STATES,
    CHATTER,
    CHATTER_LOAD,
    CHATTER_SQUARES,
    ROLLER_FIELDS,
)
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.tiers.state import State
from beardyn_core.physics.tiers.status import Status, assess, chatter_index

Float = NDArray[np.float64]

LOAD, FRICTION, REGULARISATION = 1.0e4, 0.1, 0.01
CONE_SPEED, CAGE_PULL = 9.0, 20.0


@dataclass(frozen=True)
class ContactRun:
    """A stretch of steps of the roller.

    Parameters
    ----------
    step : float
        [s].
    method : str
        ``explicit`` or ``implicit``.
    friction : float64 array, shape [step]
        On the cup contact, [N].
    speed : float
        Mean speed of the roller along the raceway, [m/s].
    """

    step: float
    method: str
    friction: Float
    speed: float

    @property
    def index(self) -> float:
        """Chatter index of the twin's own monitor, [-]."""
        return float(chatter_index(self._state(), len(self.friction)).max())

    @property
    def status(self) -> Status:
        """What the twin's own monitor says of it."""
        return assess(self._state(), len(self.friction), 0.0)

    def scatter(self, stride: int = 1) -> float:
        """Return the standard deviation of the friction at every ``stride``-th step, [N]."""
        return float(self.friction[::stride].std())

    def _state(self) -> State:
        """Make a state that holds nothing but the friction memory of this roller."""
        f = self.friction
        bend, move = f[1:-1] - 0.5 * (f[:-2] + f[2:]), 0.5 * (f[2:] - f[:-2])
        rollers = np.zeros((1, ROLLER_FIELDS, 2))
        rollers[0, CHATTER + CHATTER_SQUARES] = np.maximum(bend**2 - 0.5 * move**2, 0.0).sum()
        rollers[0, CHATTER + CHATTER_LOAD] = (FRICTION * LOAD) ** 2 * len(f)
        return State(
            rollers,
            np.zeros((4, BODY_STATES)),
            np.zeros(ENERGY_TERMS),
            np.zeros((0, 2, 2)),
            np.zeros((2, 2, 0)),
        )


def largest_explicit_step(bearing: Bearing) -> float:
    """Return the longest step that an explicit method can take here, [s]."""
    mass, inertia, radius = _body(bearing)
    rate = 2.0 * FRICTION * LOAD / REGULARISATION * max(1.0 / mass, radius**2 / inertia)
    return 2.0 / rate


def step_roller(bearing: Bearing, step: float, method: str = "explicit", seconds: float = 0.02) -> ContactRun:
    """Run the roller and keep its second half.

    Parameters
    ----------
    bearing : Bearing
        Whose roller it is.
    step : float
        [s].
    method : str
        ``explicit`` (symplectic Euler, as the fast explicit codes) or ``implicit`` (the twin's way: secant
        friction solved for the new speed).
    seconds : float
        Simulated, [s].
    """
    mass, inertia, radius = _body(bearing)
    full = FRICTION * LOAD
    count = round(seconds / step)
    kept = np.empty(count)
    # 1 mm/s of slip to begin with
    along, spin, total = 0.5 * CONE_SPEED, -0.5 * CONE_SPEED / radius + 1e-3 / radius, 0.0
    for index in range(count):
        cup_slip, cone_slip = along + radius * spin, along - radius * spin - CONE_SPEED
        cup_rate = full / math.hypot(cup_slip, REGULARISATION)
        cone_rate = full / math.hypot(cone_slip, REGULARISATION)
        if method == "explicit":
            cup_force, cone_force = -cup_rate * cup_slip, -cone_rate * cone_slip
            along += step / mass * (cup_force + cone_force - CAGE_PULL)
            spin += step * radius / inertia * (cup_force - cone_force)
        else:
            along, spin = _implicit(
                along, spin, cup_rate, cone_rate, mass / step, inertia / (step * radius**2), radius
            )
            cup_force = -cup_rate * (along + radius * spin)
        kept[index] = cup_force
        if index >= count // 2:
            total += along
    return ContactRun(step, method, kept[count // 2 :], total / (count - count // 2))


@dataclass(frozen=True)
class HiddenChatter:
    """What a step length does to the roller, as a row of a table.

    Parameters
    ----------
    method : str
    step : float
        [s].
    mean : float
        Friction on the cup; half of the cage's pull is right, [N].
    scatter, scatter_every_second : float
        Standard deviation at every step and at every second one, [N].
    index : float
        Chatter index of the twin's monitor, [-].
    status : int
        Bits of the twin's monitor.
    """

    method: str
    step: float
    mean: float
    scatter: float
    scatter_every_second: float
    index: float
    status: int


def hidden_chatter(bearing: Bearing) -> tuple[HiddenChatter, ...]:
    """Step explicitly across the limit, and as the twin does with longer steps."""
    rows = []
    ways = [("explicit", step) for step in (1e-7, 5e-7, 1e-6, 2e-6, 5e-6)]
    ways += [("implicit", step) for step in (1e-5, 4e-5)]
    for method, step in ways:
        run = step_roller(bearing, step, method)
        rows.append(
            HiddenChatter(
                method, step, float(run.friction.mean()), run.scatter(), run.scatter(2), run.index,
                int(run.status),
            )
        )  # fmt: skip
    return tuple(rows)


def _implicit(
    along: float, spin: float, cup: float, cone: float, mass: float, inertia: float, radius: float
) -> tuple[float, float]:
    """Solve (M/h + C) v' = M v/h + f for the new speeds, C the secant friction; the spin as surface speed."""
    surface = radius * spin
    diagonal_1, diagonal_2, beside = mass + cup + cone, inertia + cup + cone, cup - cone
    right_1 = mass * along - CAGE_PULL + cone * CONE_SPEED
    right_2 = inertia * surface - cone * CONE_SPEED
    determinant = diagonal_1 * diagonal_2 - beside * beside
    new_along = (right_1 * diagonal_2 - beside * right_2) / determinant
    new_surface = (diagonal_1 * right_2 - beside * right_1) / determinant
    return new_along, new_surface / radius


def _body(bearing: Bearing) -> tuple[float, float, float]:
    return bearing.roller_mass, bearing.roller_axial_inertia, 0.5 * bearing.roller_diameter
