"""Experiments: a set of runs has one description, one engine, one store and one loop.

=========== ==============================================================================
module      responsibility
=========== ==============================================================================
plan        what each run of a set is, by a key of its own; what is there of it already
loop        tasks of a plan to the engine, what comes back to the store; progress, losses
store       results in a file of JSON lines, by which an interrupted set goes on
code_digest digests of code: of a monitor, and of all that a simulated run depends on
engine      tasks to the workers, what they give back as it comes; lost workers
cluster     where the work is done: processes of this machine, or an address
local       the process that holds a scheduler and its workers on this machine
=========== ==============================================================================

Sweeps, benchmarks of monitors (trials), accuracy studies (ladders), hard cases, random scenes, studies of
steps and of structure are all such sets. Dask is imported when the first process is wanted.
"""

from beardyn_core.experiments.cluster import Cluster, Tls, core_count
from beardyn_core.experiments.engine import Ended, Engine, EngineError, ThisProcess

__all__ = ["Cluster", "Ended", "Engine", "EngineError", "ThisProcess", "Tls", "core_count"]
