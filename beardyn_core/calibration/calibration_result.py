"""What a calibration has come to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.calibration.fitting import Fit, Fitted, rms
from beardyn_core.calibration.spectra import Reception
from beardyn_core.scene.scene import Scene

_WITHIN = 2.0  # tolerances, that a band of a good twin is off by at most


@dataclass(frozen=True, eq=False)
class Calibration:
    """What a calibration has come to."""

    scene: A[Scene, "of the axlebox"]
    text: A[str, "of its file"]
    found: A[Fitted, "values with intervals, measured minus twin in each band before and after"]
    absent: A[tuple[str, ...], "what is not fitted as the scene has none of it, in sentences"]
    reception: A[Reception, "axes, sampling rate, and the bands compared"]
    speeds: A[tuple[float, ...], "of the shaft at which twins ran, [Hz]"]
    stretches: A[int, "that were used"]

    @property
    def fits(self) -> tuple[Fit, ...]:
        """What was to be fitted."""
        return self.found.fits

    def __getitem__(self, name: str) -> Fit:
        """Find an unknown by its name."""
        return next(each for each in self.fits if each.unknown.name == name)

    @property
    def residuals(self) -> tuple[float, float]:
        """Root mean square of measured minus twin before and after, [dB]."""
        return rms(self.found.before), rms(self.found.after)

    @property
    def sentences(self) -> list[str]:
        """List everything, a line each."""
        before, after = self.residuals
        within = np.mean(np.abs(self.found.after) <= _WITHIN * self.found.tolerance)
        return [
            *(each.sentence for each in self.fits),
            *self.absent,
            f"measured minus twin in twelfths of an octave, root mean square: {before:.1f} dB before, "
            f"{after:.1f} dB after; {100 * within:.0f} % of the bands within {_WITHIN:g} tolerances",
            *(["the search was interrupted: these are the best values so far"] * self.found.interrupted),
        ]
