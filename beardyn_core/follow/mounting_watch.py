"""The mounting of a sensor over the latest stretches, as they come."""

from __future__ import annotations

from collections import deque

from beardyn_core.base.arrays import Float
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.mounting import Mounting, check_mounting
from beardyn_core.follow.mounting_search import cross_powers, strangeness_of_powers
from beardyn_core.monitor.chain import Stretch

LATEST = 8  # stretches, whose middle is judged: one that is strange for another reason does not decide
_FEWEST = 2  # before a mounting is searched for
_AGAIN = 8  # stretches after which a strange signal is searched anew


class MountingWatch:
    """Decides when a search of the mounting is due, and keeps what it has found.

    Parameters
    ----------
    estimator : Estimator
        One of fewer than three axes knows no mounting, and no search is due.

    Attributes
    ----------
    found : tuple of Mounting
        By the last search.
    """

    def __init__(self, estimator: Estimator) -> None:
        self._estimator = estimator
        self._powers: deque[Float] = deque(maxlen=LATEST)
        self._wait = 0  # stretches until the next search
        self.found: tuple[Mounting, ...] = ()

    def take(self, stretch: Stretch) -> None:
        """Take a stretch; where the latest are familiar, nothing is wrong with the mounting any more."""
        if self._estimator.axes != AXES:
            return
        self._powers.append(cross_powers(stretch))
        self._wait = max(self._wait - 1, 0)
        if strangeness_of_powers(self._powers, self._estimator) <= 1.0:
            self.found, self._wait = (), 0

    def due(self) -> list[Float]:
        """Give the powers to search by where it is time to; empty otherwise."""
        if self._wait or len(self._powers) < _FEWEST:
            return []
        if strangeness_of_powers(self._powers, self._estimator) <= 1.0:
            return []
        self._wait = _AGAIN
        return list(self._powers)

    @property
    def sentence(self) -> str:
        """Ask for a check of the sensor; empty where nothing is found."""
        return check_mounting([each.sentence for each in self.found]) if self.found else ""
