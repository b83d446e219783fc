"""When a block is due on the wall clock."""

from __future__ import annotations

import threading
import time

LATE_AFTER_S = 0.040


class Pacer:
    """Maps simulated time to the wall clock; never touches what is simulated.

    Parameters
    ----------
    speed_factor : float
        Simulated seconds per wall second; 0: as fast as it goes.
    """

    def __init__(self, speed_factor: float) -> None:
        self._lock = threading.Lock()
        self._speed_factor = speed_factor
        self.begin()

    def begin(self) -> None:
        """Start a run: simulated time 0 is now."""
        with self._lock:
            self._origin_wall = time.monotonic()
            self._origin_s = 0.0
            self._now_s = 0.0
            self.late_blocks = 0
            self.lag_s = 0.0  # of the last block behind its due time
            self.worst_lag_s = 0.0

    @property
    def speed_factor(self) -> float:
        """Simulated seconds per wall second; 0: as fast as it goes."""
        return self._speed_factor

    def set_speed_factor(self, speed_factor: float) -> None:
        """Change the pace from now on."""
        with self._lock:
            self._origin_wall = time.monotonic()
            self._origin_s = self._now_s
            self._speed_factor = speed_factor

    def shift(self, seconds: float) -> None:
        """Leave out time that was spent waiting for somebody else."""
        with self._lock:
            self._origin_wall += seconds

    def delay(self, end_ns: int) -> float:
        """Compute the seconds until a block that ends at `end_ns` is due; 0 or negative: due."""
        with self._lock:
            if self._speed_factor == 0.0:
                return 0.0
            return self._due(end_ns) - time.monotonic()

    def check_late(self, end_ns: int) -> None:
        """Note how late the block is, and count it when that is more than 40 ms."""
        with self._lock:
            if self._speed_factor > 0.0:
                self.lag_s = max(time.monotonic() - self._due(end_ns), 0.0)
                self.worst_lag_s = max(self.worst_lag_s, self.lag_s)
                self.late_blocks += self.lag_s > LATE_AFTER_S
            self._now_s = end_ns * 1e-9

    def _due(self, end_ns: int) -> float:
        return self._origin_wall + (end_ns * 1e-9 - self._origin_s) / self._speed_factor
