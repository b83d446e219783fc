"""Rating lives of a bearing over load, lateral load, viscosity ratio and contamination, interpolated.

The lives are those of `physics.statics.rating_life`, solved once on a grid, so that thousands of draws cost
as much as one look.
"""

from __future__ import annotations

from math import log
from typing import NamedTuple

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.any_bearing import with_play
from beardyn_core.bearing.life import (
    LIFE_EXPONENT,
    SMALLEST_LAMINA_COUNT,
    dynamic_rating,
    reference_life,
)
from beardyn_core.bearing.roller_bearing import RollerBearing

_LOADS = np.exp(np.linspace(log(0.45), log(2.2), 5))  # over the load in the middle
_THRUSTS = np.array(
    [0.0, 0.06, 0.14, 0.24, 0.36, 0.55, 1.0]
)  # size of the lateral load over the vertical one
_FEW_LOADS, _FEW_THRUSTS = _LOADS[[0, 2, 4]], _THRUSTS[[0, 2, 3, 4, 6]]  # of the effect of the play
_RATIOS = np.exp(np.linspace(log(0.1), log(4.0), 12))  # kappa; beyond both ends the standard takes these
_CONTAMINATIONS = np.array([0.2, 0.35, 0.5, 0.6, 0.7, 0.85, 1.0])
_PLAYS = np.array([-1.0, 0.0, 1.0])
PLAY_STEP = 0.8e-4  # [m]
REACH = 0.7, 1.4  # over the load in the middle, within which a surface serves


class Lives(NamedTuple):
    """Lives of ISO 281 and ISO 16281, basic and modified, each shape [draw], [revolutions]."""

    equivalent_load: Float  # P of ISO 281, [N]
    basic: Float  # L_10
    reference_basic: Float  # L_10r
    reference_modified: Float  # L_10mr


class LifeSurface:
    """Lives of one bearing around a load, a play and a speed.

    Parameters
    ----------
    bearing : RollerBearing
    load : float
        Vertical, in the middle of the grid, [N].
    play : float
        End play in the middle, of cylindrical and spherical bearings radial clearance, [m].
    speed : float
        Of the shaft, for the inertia of the rollers, [rad/s].

    Notes
    -----
    The effect of the play is solved for fewer loads and thrusts than the rest. Draws beyond the grid are
    taken at its edge, loads there by the exponent of the standard.
    """

    def __init__(self, bearing: RollerBearing, load: float, play: float, speed: float) -> None:
        from beardyn_core.physics.statics.static import solve  # brings the compiler along

        self.bearing, self.load, self.play = bearing, load, play

        def loads_of(share: float, thrust: float, steps: float) -> tuple[Float, Float]:
            up = share * load
            fitted, end_play = with_play(bearing, play + steps * PLAY_STEP)
            static = solve(
                fitted, (0.0, thrust * up, up), (0.0, 0.0, 0.0),
                end_play=end_play, tilt="locked", laminae=SMALLEST_LAMINA_COUNT,
                speed=abs(speed),
            )  # fmt: skip
            return static.cup_lamina_load, static.cone_lamina_load

        def basic_of(loads: tuple[Float, Float]) -> float:
            return reference_life(bearing, *loads, 1.0, 0.5).basic

        held = [[loads_of(share, thrust, 0.0) for thrust in _THRUSTS] for share in _LOADS]
        basic = np.log([[basic_of(each) for each in line] for line in held])
        modified = [
            [
                [
                    [reference_life(bearing, *each, kappa, clean).modified for clean in _CONTAMINATIONS]
                    for kappa in _RATIOS
                ]
                for each in line
            ]
            for line in held
        ]
        factor = np.log(modified) - basic[:, :, None, None]
        plays = np.log(
            [
                [[basic_of(loads_of(share, thrust, way)) for thrust in _FEW_THRUSTS] for share in _FEW_LOADS]
                for way in (-1.0, 1.0)
            ]
        )
        usual = basic[np.ix_([0, 2, 4], [0, 2, 3, 4, 6])]
        plays = np.array([plays[0] - usual, np.zeros_like(usual), plays[1] - usual])
        axes = (np.log(_LOADS), _THRUSTS)
        self._basic = RegularGridInterpolator(axes, basic, method="cubic")
        self._factor = RegularGridInterpolator((*axes, np.log(_RATIOS), _CONTAMINATIONS), factor)
        self._play = RegularGridInterpolator((_PLAYS, np.log(_FEW_LOADS), _FEW_THRUSTS), plays)
        self._rating = dynamic_rating(bearing)

    def serves(self, load: float) -> bool:
        """Tell whether a load is near enough to the middle."""
        low, high = REACH
        return low * self.load <= load <= high * self.load

    def lives(
        self, vertical: Float, lateral: Float, play: Float, ratio: Float, contamination: Float
    ) -> Lives:
        """Give the lives of draws, each argument of shape [draw], SI; `ratio` is kappa."""
        share = np.clip(np.log(vertical / self.load), *np.log(_LOADS[[0, -1]]))
        thrust = np.clip(np.abs(lateral) / vertical, 0.0, _THRUSTS[-1])
        steps = np.clip((play - self.play) / PLAY_STEP, -1.0, 1.0)
        kappa = np.log(np.clip(ratio, _RATIOS[0], _RATIOS[-1]))
        clean = np.clip(contamination, _CONTAMINATIONS[0], 1.0)
        # loads beyond the grid: the exponent of the standard
        beyond = LIFE_EXPONENT * (np.log(vertical / self.load) - share)
        ln_basic = self._basic((share, thrust)) + self._play((steps, share, thrust)) - beyond
        ln_factor = self._factor((share, thrust, kappa, clean))
        loads = np.array(
            [
                self._rating.equivalent_load(up, side)
                for up, side in zip(vertical.tolist(), lateral.tolist(), strict=True)
            ]
        )
        basic = 1e6 * (self._rating.radial / loads) ** LIFE_EXPONENT
        return Lives(loads, basic, np.exp(ln_basic), np.exp(ln_basic + ln_factor))
