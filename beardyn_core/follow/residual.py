"""What a twin at the state that is known does not have of what is measured, band by band."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.follow.descriptors import THIRDS, names_of
from beardyn_core.follow.estimator import Estimator

_USUAL = 2.0  # spreads of a band among all runs learnt from: a twin at the right state is not as far off
_LEAST = 6.0  # [dB], what track and wheel may differ in whatever the band
_TOGETHER = 3  # bands side by side before it is said


@dataclass(frozen=True, eq=False)
class Residual:
    """Levels of what is measured next to those of a twin, in third octaves."""

    axes: A[tuple[str, ...], "of the accelerometer"]
    middles: A[Float, "shape [band], [Hz]"]
    measured: A[Float, "shape [axis, band], [dB re 1 m/s^2]"]
    twin: A[Float, "shape [axis, band], [dB re 1 m/s^2]"]
    tolerance: A[Float, "shape [axis, band], [dB]"]

    @property
    def difference(self) -> Float:
        """Measured minus twin, shape [axis, band], [dB]."""
        return self.measured - self.twin

    @property
    def explained(self) -> float:
        """Share of the bands that are within their tolerance."""
        known = np.isfinite(self.difference)
        return float(np.mean(np.abs(self.difference[known]) <= self.tolerance[known])) if known.any() else 1.0

    @property
    def sentences(self) -> tuple[str, ...]:
        """Say where several bands side by side are too loud or too quiet for the twin."""
        found = []
        for axis, off, most in zip(self.axes, self.difference, self.tolerance, strict=True):
            for side, word in ((1.0, "louder"), (-1.0, "quieter")):
                begin = 0
                beyond = np.append(side * off > most, False)
                for k, far in enumerate(beyond):
                    if far:
                        continue
                    if k - begin >= _TOGETHER:
                        level = float(np.median(np.abs(off[begin:k])))
                        low, high = self.middles[begin], self.middles[k - 1]
                        found.append(
                            f"{axis} from {low:.0f} to {high:.0f} Hz is {level:.0f} dB {word} than the twin"
                        )
                    begin = k + 1
        return tuple(found)


def residual_of(estimator: Estimator, received: Float, twin: Float) -> Residual:
    """Compare the middle of measured stretches, shape [stretch, descriptor], with those of a twin."""
    names = names_of(estimator.axes)
    places = [[names.index(f"band_{axis}_{middle:.0f}") for middle in THIRDS] for axis in estimator.axes]
    return Residual(
        estimator.axes,
        np.array(THIRDS),
        np.median(received, axis=0)[places],
        np.median(twin, axis=0)[places],
        np.maximum(_USUAL * estimator.spread[places], _LEAST),
    )
