"""The process that holds a scheduler and its workers: ``python -m beardyn_core.experiments.local SETTINGS``.

It writes its address as a line of JSON, and ends when its standard input does.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from typing import Any


def main(settings: dict[str, Any]) -> None:
    """Start the workers, tell the address, and stay until the standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    import dask
    from distributed import LocalCluster

    # one worker more or less must not change a run, and linear algebra in threads would only wait
    dask.config.set(
        {
            "distributed.scheduler.worker-saturation": 1.0,
            "distributed.admin.tick.interval": "100ms",
            "distributed.comm.timeouts.connect": "60s",
            "distributed.scheduler.allowed-failures": 3,
            # above its memory a worker is started anew; one that only paused would wait for ever, for what it
            # holds are kernels, and no results that could go to the disk
            "distributed.worker.memory.target": False,
            "distributed.worker.memory.spill": False,
            "distributed.worker.memory.pause": False,
            # Dask looks at what its workers do a hundred times a second, and lets them give every array back
            # to the system at once: that is half of the processor time of a short run
            "distributed.worker.profile.enabled": False,
            "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": 1 << 26,
            "distributed.nanny.pre-spawn-environ.MALLOC_MMAP_THRESHOLD_": 1 << 25,
        }
    )
    memory = settings["memory"]
    cluster = LocalCluster(
        n_workers=settings["workers"],
        threads_per_worker=1,
        processes=True,
        memory_limit="auto" if memory is None else int(memory),
        dashboard_address="127.0.0.1:0",
        host="127.0.0.1",
        silence_logs=50,
    )
    told = {"address": cluster.scheduler_address, "dashboard": cluster.dashboard_link or ""}
    print(json.dumps(told), flush=True)
    while sys.stdin.buffer.read(1):
        pass
    os._exit(0)  # the workers end with this process


if __name__ == "__main__":
    main(json.loads(sys.argv[1]))
