"""Simulated time on the wall clock: when a block is due, and how late it was."""

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
            self.last_late_s = 0.0  # simulated time of the last late block
            self.lag_s = 0.0  # of the last published block behind its due time
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

    def simulated_at(self, wall: float) -> float:
        """Compute the simulated time that is due at a time of `time.monotonic`, [s]."""
        with self._lock:
            return self._origin_s + (wall - self._origin_wall) * self._speed_factor

    def hand_over(self, end_ns: int) -> float | None:
        """Note the time that the run has reached; when its block was due, [s] of `time.monotonic`.

        ``None`` without a pace.
        """
        with self._lock:
            self._now_s = end_ns * 1e-9
            return self._due(end_ns) if self._speed_factor > 0.0 else None

    def check_published(self, end_ns: int, due_at: float | None) -> None:
        """Note how late a block has just been published; more than 40 ms are counted."""
        if due_at is None:
            return
        with self._lock:
            self.lag_s = max(time.monotonic() - due_at, 0.0)
            self.worst_lag_s = max(self.worst_lag_s, self.lag_s)
            if self.lag_s > LATE_AFTER_S:
                self.late_blocks, self.last_late_s = self.late_blocks + 1, end_ns * 1e-9

    def _due(self, end_ns: int) -> float:
        return self._origin_wall + (end_ns * 1e-9 - self._origin_s) / self._speed_factor
