"""The load on the journal from a topic, averaged over stretches, where its operator trusts it."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.follow.known_load import ASSUMED_SHARE, LEAST_N, MOST_N, KnownLoad, checked
from beardyn_core.record.load_stream import decode_load
from beardyn_core.record.messages import decode, header_stamp
from beardyn_core.record.topics import WRENCH

TOPIC = re.compile(r"topic(?:\s*:\s*(\d+\.?\d*)\s*%)?")
KEPT_S = 60.0  # of samples, for a follower that is behind


class LoadReception:
    """Samples of the vertical load as they come, and their mean over a time.

    Parameters
    ----------
    text : str
        ``topic`` or ``topic:5%``, half of the 90 % interval of the mean.

    Raises
    ------
    InputError
        The uncertainty is none.
    """

    def __init__(self, text: str) -> None:
        match = TOPIC.fullmatch(text.strip())
        if match is None:
            raise InputError(f"is {text!r}; write topic or topic:UNCERTAINTY%, such as topic:5%")
        self._share = ASSUMED_SHARE if match[1] is None else float(match[1]) / 100.0
        self._assumed = f"uncertainty of {100 * ASSUMED_SHARE:.0f} % assumed" if match[1] is None else ""
        checked(KnownLoad(1.0, self._share), f"is {text!r}")
        self._time: list[Int] = []
        self._force: list[Float] = []
        self.doubt = ""

    @property
    def handlers(self) -> Mapping[str, Callable[[bytes], None]]:
        """Handlers of the topics of the load by their names."""
        return {"load/blocks": self._take_block, "load/wrench": self._take_wrench}

    def clear(self) -> None:
        """Forget what has come: the run starts again."""
        self._time, self._force, self.doubt = [], [], ""

    def _take_block(self, cdr: bytes) -> None:
        history, _ = decode_load(cdr)
        if len(history):
            self._take(history.time_ns, history.wrench[:, 2])

    def _take_wrench(self, cdr: bytes) -> None:
        message: Any = decode(WRENCH, cdr)
        self._take(np.array([header_stamp(cdr)]), np.array([float(message.wrench.force.z)]))

    def _take(self, time_ns: Int, force: Float) -> None:
        good = np.isfinite(force)
        self._time.append(time_ns[good])
        self._force.append(force[good])
        if good.any():
            begin = int(time_ns[-1]) - round(1e9 * KEPT_S)
            while len(self._time) > 1 and (not len(self._time[0]) or self._time[0][-1] < begin):
                del self._time[0], self._force[0]

    def load_between(self, begin_ns: int, end_ns: int) -> KnownLoad | None:
        """Give the mean load of a time; none where no sample of it came, or they are no load of a journal."""
        if not self._time:
            self.doubt = "parameter 'load' is topic, but no load comes on load/blocks or load/wrench"
            return None
        time_ns, force = np.concatenate(self._time), np.concatenate(self._force)
        inside = force[(time_ns >= begin_ns) & (time_ns <= end_ns)]
        mean = float(inside.mean()) if len(inside) else math.nan
        if not LEAST_N <= mean <= MOST_N:
            what = "has no sample in this stretch" if math.isnan(mean) else f"is {mean:.4g} N on average"
            self.doubt = f"the load of the topic {what}; allowed are {LEAST_N:g} to {MOST_N:g} N, upwards"
            return None
        self.doubt = ""
        return KnownLoad(mean, self._share * mean, "topic", self._assumed)
