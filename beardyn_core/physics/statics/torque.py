"""Torque of a bearing that rolls under static loads: rolling resistance of the raceways, and the ribs.

No motion is simulated: the static solution gives the load of every contact, pure rolling its speeds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, get_args

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.jit import plain
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.starved_rolling import FLOODED, OilSupply
from beardyn_core.effects import Rib, RollingResistance
from beardyn_core.effects.rolling_resistance import RollingKind
from beardyn_core.physics.bodies.layout import CONE, CUP
from beardyn_core.physics.flanges import FlangeParams, flange_params, flange_torque
from beardyn_core.physics.pure_rolling import pure_rolling
from beardyn_core.physics.rib import RibParams, large_rib_params
from beardyn_core.physics.rib_friction import sliding_torque
from beardyn_core.physics.rolling_resistance import moving_couple, rolling_params, rolling_torque
from beardyn_core.physics.statics.static import StaticSolution

USUAL_RESISTANCE = RollingResistance()


@dataclass(frozen=True)
class RunningTorque:
    """Running torque of a bearing, by where it arises."""

    cup_couple: Float  # [row, roller], on each roller against its rolling on the raceway [N m]
    cone_couple: Float
    rolling: float  # on the shaft [N m]
    rib: float

    @property
    def total(self) -> float:
        """Add up the torque on the shaft, [N m]."""
        return self.rolling + self.rib


def entrainment_speeds(bearing: RollerBearing, speed: float) -> tuple[float, float]:
    """Work out entrainment speeds on cup and cone in pure rolling, contact-fixed frame, [m/s]."""
    orbit = cage_speed(bearing, abs(speed))
    return orbit * bearing.cup_radius, (abs(speed) - orbit) * bearing.cone_radius


def running_torque(
    bearing: RollerBearing,
    lubricant: Lubricant,
    temperature: float,
    static: StaticSolution,
    speed: float,
    *,
    resistance: RollingResistance = USUAL_RESISTANCE,
    supply: OilSupply = FLOODED,
    rib: Rib | None = None,
) -> RunningTorque:
    """Work out the running torque in pure rolling under the loads of a static equilibrium.

    Parameters
    ----------
    temperature : float
        Of the lubricant at the inlets, [K].
    speed : float
        Of the shaft, [rad/s].
    resistance : RollingResistance
        Options of the rolling resistance.
    supply : OilSupply
        How much oil the contacts find.
    rib : Rib, optional
        Options of the friction on the rib; none by default.

    Raises
    ------
    InputError
        Unknown kind of resistance.

    References
    ----------
    Zhao et al. (2026), J. Braz. Soc. Mech. Sci. Eng. 48:241: T = sum (1/Dm)(R_o T_i + R_i T_o), and on the
    rib mu Q_f h sqrt(1 + 0.18 (a/h)^2) R_o/Dm. The equivalent radius and the entrainment speed are not
    those printed there: the cup is concave, and surface speeds are taken against the contact.
    """
    allowed = get_args(RollingKind)
    if resistance.kind not in allowed:
        raise InputError([f"kind is {resistance.kind!r}; allowed are {', '.join(allowed)}."])
    motion, loads = pure_rolling(bearing), (static.cup_load, static.cone_load)
    speeds = abs(speed), motion.cage_ratio * abs(speed)
    resisting = rolling_params(bearing, resistance, lubricant, temperature, supply)
    cup, cone = (
        plain(moving_couple)(load, entrainment, ring, resisting)
        for ring, load, entrainment in zip(
            (CUP, CONE), loads, entrainment_speeds(bearing, speed), strict=True
        )
    )
    rolling = float(np.sum(plain(rolling_torque)(loads, speeds, motion, resisting)))
    law = large_rib_params(bearing, rib, lubricant, temperature)
    sliding = rib_torque(bearing, static, speed, law)
    sliding += flanges_torque(static, speed, flange_params(bearing, rib, lubricant, temperature))
    return RunningTorque(cup, cone, rolling, sliding)


def rib_torque(bearing: RollerBearing, static: StaticSolution, speed: float, rib: RibParams | None) -> float:
    """Work out the torque on the shaft of all large ends that slide on their ribs in pure rolling, [N m].

    Parameters
    ----------
    speed : float
        Of the shaft, [rad/s].
    rib : RibParams, optional
        As the steps have it, with its film; ``None`` for ribs without friction.
    """
    motion, cone = pure_rolling(bearing), _Cone(math.sin(bearing.cone_angle), math.cos(bearing.cone_angle))
    speeds = abs(speed), motion.cage_ratio * abs(speed)
    loads = static.rib_load[static.rib_load > 0.0]
    return float(np.sum(plain(sliding_torque)(loads, speeds, motion, cone, rib)))


def flanges_torque(static: StaticSolution, speed: float, flanges: FlangeParams | None) -> float:
    """Work out the torque on the shaft of all ends of cylindrical rollers on ribs in pure rolling, [N m].

    A roller that is pushed along leans on one rib of each ring. ``speed``: of the shaft [rad/s].
    """
    if flanges is None:
        return 0.0
    total = 0.0
    for loads, ribs in (
        (static.rib_load, (flanges.cone_outer, flanges.cone_inner)),
        (static.cup_rib_load, (flanges.cup_outer, flanges.cup_inner)),
    ):
        found = next((rib for rib in ribs if rib is not None), None)
        if found is not None and loads.size:
            total += float(np.sum(plain(flange_torque)(loads[loads > 0.0], abs(speed), found)))
    return total


class _Cone(NamedTuple):
    """What `sliding_torque` reads of the cone."""

    sine: float
    cosine: float
