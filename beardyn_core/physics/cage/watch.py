"""Watch of the cages: their speed over that of pure rolling, in the mean over a revolution of theirs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import KinematicCage
from beardyn_core.physics.bodies.layout import CAGE_BODY, RATE
from beardyn_core.scene.scene import Scene

LARGEST_RATIO = 1.01
SMALLEST_RATIO = 0.0
_STANDSTILL = 0.1


@dataclass(frozen=True)
class CageWatch:
    """Speeds of both cages so far."""

    ratio: A[tuple[float, ...], "of each cage, mean over about a revolution; empty at first"] = ()
    turned: A[float, "revolutions of a cage in pure rolling since the start"] = 0.0

    @classmethod
    def of(cls, scene: Scene) -> CageWatch | None:
        """Make a watch for cages that raceway traction drives; None where there are none."""
        effects = scene.effects
        if effects.traction is None or effects.cage is None or isinstance(effects.cage, KinematicCage):
            return None
        return None if "cage" in scene.missing_effects else cls()

    def after(self, bearing: RollerBearing, bodies: Float, shaft_speed: float, seconds: float) -> CageWatch:
        """Take a block into the mean.

        Parameters
        ----------
        bodies : float64 array, shape [instant, body, field]
            States within the block.
        shaft_speed : float
            Mean of the block, [rad/s]; a shaft that stands is left out.
        seconds : float
            Length of the block.
        """
        rolling = cage_speed(bearing, shaft_speed)
        if abs(shaft_speed) < _STANDSTILL:
            return self
        now = bodies[:, CAGE_BODY:, RATE].mean(axis=0) / rolling
        turned = abs(rolling) * seconds / (2.0 * math.pi)
        before = np.array(self.ratio) if self.ratio else now
        # the first revolution is averaged as a whole: of a start the first instants hardly count
        kept = min(math.exp(-turned), self.turned / (self.turned + turned))
        mean = now + (before - now) * kept
        return CageWatch(tuple(float(each) for each in mean), self.turned + turned)

    @property
    def is_fast(self) -> bool:
        """Whether a cage that has turned around runs ahead of rolling rollers."""
        return self._has_turned and max(self.ratio) > LARGEST_RATIO

    @property
    def is_backwards(self) -> bool:
        """Whether a cage that has turned around runs against the shaft."""
        return self._has_turned and min(self.ratio) < SMALLEST_RATIO

    @property
    def _has_turned(self) -> bool:
        return self.turned >= 1.0 and bool(self.ratio)
