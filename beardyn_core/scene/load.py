"""Loads on the journal as a function of time: the history, and the buffer a stream fills."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

WRENCH_AXES = ("fx", "fy", "fz", "mx", "my", "mz")

# Samples on either side of a moment that its load depends on, where they are interpolated band-limited
LOOK_AHEAD = 30
LONGEST_SPACING_NS = 11_000_000
UNEVENNESS = 0.02  # of the spacing from one sample to the next


@dataclass(frozen=True)
class LoadHistory:
    """Samples of the load on the journal and the shaft speed.

    In between a column is band-limited (`scene.band_limited`) where the `LOOK_AHEAD` samples on either side
    are evenly spaced, within `UNEVENNESS`, by at most `LONGEST_SPACING_NS`, and at least half of them lie off
    the line between their neighbours. Elsewhere it is linear: tables of few points, uneven samples, and
    steps, ramps and holds that were drawn by ruler.
    """

    time_ns: A[NDArray[np.int64], "shape [sample], simulated time, strictly increasing, [ns]"]
    wrench: A[
        NDArray[np.float64],
        "shape [sample, 6], force and moment on the journal at the bearing centre, [N, N m]: the wheel-rail "
        "reaction less the static weight of the half wheelset",
    ]
    shaft_speed: A[
        NDArray[np.float64],
        "shape [sample], speed of the shaft about +y, positive when rolling forward, [rad/s]",
    ]
    bogie: A[
        NDArray[np.float64],
        "shape [sample, 3], displacement of the bogie end of the suspension from its static place, [m]",
    ]

    def __len__(self) -> int:
        return len(self.time_ns)

    def columns(self) -> NDArray[np.float64]:
        """Gather wrench, shaft speed and bogie displacement, shape [sample, 10]."""
        return np.concatenate([self.wrench, self.shaft_speed[:, None], self.bogie], axis=1)

    def until(self, time_ns: int) -> LoadHistory:
        """Return the samples up to a time, and the first one after it."""
        return self.part(0, int(np.searchsorted(self.time_ns, time_ns)) + 1)

    def part(self, first: int, last: int) -> LoadHistory:
        """Return the samples ``first`` (included) to ``last`` (excluded)."""
        return LoadHistory(
            self.time_ns[first:last],
            self.wrench[first:last],
            self.shaft_speed[first:last],
            self.bogie[first:last],
        )


def sampled_load(
    wrench: NDArray[np.float64], shaft_speed: NDArray[np.float64], bogie: NDArray[np.float64], sample_ns: int
) -> LoadHistory:
    """Make the history of samples that follow each other every so many nanoseconds from time 0."""
    time_ns = np.arange(len(shaft_speed), dtype=np.int64) * sample_ns
    columns = (np.ascontiguousarray(part, dtype=np.float64) for part in (wrench, shaft_speed, bogie))
    return LoadHistory(time_ns, *columns)
