"""A node of the package on a disk that stalls: ``python -m test.ros.slow_disk STALL_S recorder ...``."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any, BinaryIO

from beardyn_core.record import mcap_writing

BYTES_BEFORE_STALL = 400_000


class SlowFile:
    """A file whose disk stops once for a while, as one that spins up or is flooded by somebody else."""

    def __init__(self, file: BinaryIO, stall_s: float) -> None:
        self._file = file
        self._stall_s = stall_s
        self._written = 0

    def write(self, data: bytes) -> int:
        self._written += len(data)
        if self._stall_s and self._written > BYTES_BEFORE_STALL:
            stall, self._stall_s = self._stall_s, 0.0
            print(f"the disk stalls for {stall:g} s", flush=True)
            time.sleep(stall)
        return self._file.write(data)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._file, name)


def main(stall_s: float, words: list[str]) -> int:
    from beardyn_ros.__main__ import main as beardyn_ros

    open_to_write = mcap_writing.open_to_write

    def slowly(path: Path, *, replace: bool = False) -> Any:
        return SlowFile(open_to_write(path, replace=replace), stall_s)

    mcap_writing.open_to_write = slowly
    return beardyn_ros(words)


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]), sys.argv[2:]))
