"""The engine: many runs at once, on the cores of this machine or on any Dask cluster.

======= ====================================================================
module  responsibility
======= ====================================================================
cluster where the work is done: processes of this machine, or an address
local   the process that holds a scheduler and its workers on this machine
engine  tasks to the workers, what they give back as it comes; lost workers
======= ====================================================================

Sweeps, trials, ladders, hard cases, studies of steps and of structure all run on it. Dask is imported when
the first process is wanted.
"""

from beardyn_core.engine.cluster import Cluster, Tls, core_count
from beardyn_core.engine.engine import Ended, Engine, EngineError, all_of

__all__ = ["Cluster", "Ended", "Engine", "EngineError", "Tls", "all_of", "core_count"]
