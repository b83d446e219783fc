"""A file that a slow disk does not hold up: a thread writes, the caller goes on."""

from __future__ import annotations

import threading
from collections import deque
from typing import BinaryIO

MOST_WAITING = 128 * 1024 * 1024


class BackgroundFile:
    """A file opened for writing whose bytes go to the disk in the background, in their order.

    When more than `MOST_WAITING` bytes wait, `write` waits for the disk. What the disk refuses is raised by
    the next call.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._queue: deque[bytes] = deque()
        self._waiting = 0
        self._position = 0
        self._failure: OSError | None = None
        self._ending = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._work, name="disk", daemon=True)
        self._thread.start()

    def write(self, data: bytes) -> int:
        """Hand over bytes; waits only when too many wait already."""
        if not data:
            return 0
        with self._changed:
            self._changed.wait_for(
                lambda: (
                    self._failure is not None
                    or self._waiting + len(data) <= MOST_WAITING
                    # a piece larger than everything that may wait is taken alone
                    or not self._waiting
                )
            )
            self._check()
            self._queue.append(bytes(data))
            self._waiting += len(data)
            self._position += len(data)
            self._changed.notify_all()
        return len(data)

    def tell(self) -> int:
        """Return how many bytes have been handed over."""
        return self._position

    def flush(self) -> None:
        """Raise what the disk has refused; the bytes are on their way already."""
        with self._changed:
            self._check()

    @property
    def waiting(self) -> int:
        """Bytes that the disk has not taken yet."""
        return self._waiting

    def close(self) -> None:
        """Wait for the disk, close the file, and raise what it has refused."""
        with self._changed:
            self._ending = True
            self._changed.notify_all()
        self._thread.join()
        try:
            self._check()
        finally:
            self._file.close()

    def _check(self) -> None:
        if self._failure is not None:
            raise self._failure

    def _work(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._queue or self._ending)
                if not self._queue:
                    return
                data = self._queue.popleft()
            try:
                self._file.write(data)
                if not self._queue:
                    self._file.flush()
            except OSError as error:
                with self._changed:
                    self._failure = error
                    self._queue.clear()
                    self._waiting = 0
                    self._changed.notify_all()
                return
            with self._changed:
                self._waiting -= len(data)
                self._changed.notify_all()
