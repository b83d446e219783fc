"""Simulate a scene, read a recording, let a monitor judge a run."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from beardyn_core.api.making import scene as make_scene
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.choice import scene_from_text
from beardyn_core.effects import EffectSet
from beardyn_core.errors import InputError
from beardyn_core.measured.about import mounted_in
from beardyn_core.observe.block import Block
from beardyn_core.observe.chain import REFERENCE, Algorithm, MonitorSettings
from beardyn_core.observe.summary import RunSummary
from beardyn_core.outputs import files_read, recording_problems
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.record.run_summary import life_of
from beardyn_core.record.sinks import McapSink, MemorySink, Sink
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.study import desk_run
from beardyn_core.study.monitored_recording import Conclusion, conclude, findings_of


def simulate(
    scene: str | Path | Mapping[str, Any] | Scene,
    *,
    tier: str | None = None,
    effects: str | Mapping[str, Any] | EffectSet | None = None,
    duration: float | None = None,
    laminae: int | None = None,
    seed: int | None = None,
    record: Path | str | None = None,
    force: bool = False,
    progress: bool = False,
    **changes: Any,
) -> Run:
    """Simulate a scene as fast as this machine can and keep the run in memory.

    The first run of a set of effects compiles its kernels, about half a minute; they are kept on disk.

    Parameters
    ----------
    scene : str, Path, mapping or Scene
        See `scene`, whose other arguments can be given here too: ``faults=[...]``, ``end_play_mm=0.05``.
    tier, effects, duration, laminae, seed : optional
        In place of the scene's own; see `scene`.
    record : Path, optional
        Write the run to this MCAP file too.
    force : bool
        Replace that file if it exists.
    progress : bool
        Show a bar on standard error.

    Returns
    -------
    Run
        Its ``status`` is a sentence, and a ``RuntimeWarning`` says it too, when the model left its range of
        validity; the arrays end there.

    Warns
    -----
    UserWarning
        A load or a fault is unusual, or an accelerometer has clipped: what ``beardyn simulate`` warns of.

    Raises
    ------
    InputError
        With every mistake in the scene, or the recording cannot be written.
    ValidityError
        There is no equilibrium under the first load.
    """
    asked = {"tier": tier, "effects": effects, "duration": duration, "laminae": laminae, "seed": seed}
    asked |= changes
    untouched = isinstance(scene, Scene) and all(value is None for value in asked.values())
    with files_read() as inputs:
        made = scene if isinstance(scene, Scene) and untouched else make_scene(scene, **asked)  # type: ignore[arg-type]
    memory = MemorySink()
    sinks: list[Sink] = [memory]
    if record is not None:
        if problems := recording_problems("", Path(record), inputs=inputs, force=force):
            raise InputError(problems)
        sinks.append(McapSink(record, replace=force))
    for doubt in made.doubts:
        warnings.warn(doubt, stacklevel=2)
    with _bar(made.duration, progress) as advance:
        summary = desk_run.run(made, sinks, advance, life=False)
    if not summary.complete:
        warnings.warn(summary.status, RuntimeWarning, stacklevel=2)
    for sensor, count, total in summary.clipped:
        warnings.warn(
            f"the accelerometer {sensor} has clipped {count} of {total} samples; "
            "give it a larger range_m_per_s2",
            stacklevel=2,
        )
    load = None if memory.run is None else memory.run.load
    return memory.to_run(partial(_with_life, summary, made, load))


def _with_life(summary: RunSummary, scene: Scene, load: LoadHistory | None) -> RunSummary:
    """Add the rating life under the load until the end of the run; it can take longer than a short run."""
    if load is None:
        return summary
    until = round(summary.duration * 1e9)
    return replace(summary, life=life_of(scene, load.until(until)))


@contextmanager
def _bar(total: float, shown: bool) -> Iterator[Callable[[Block], None] | None]:
    """Return a function that moves the progress bar by a block; ``None`` without a bar."""
    if not shown:
        yield None
        return
    from tqdm import tqdm

    layout = "{desc} {bar} {n:.2f}/{total:.2f} s [{elapsed}<{remaining}]"
    with tqdm(total=total, desc="simulated", bar_format=layout, leave=False) as bar:

        def advance(block: Block) -> None:
            bar.update(min((block.end_ns - block.start_ns) * 1e-9, max(bar.total - bar.n, 0.0)))

        yield advance


def read(path: Path | str, namespace: str | None = None) -> Run:
    """Read a recording; of a cut-off one everything up to the last complete chunk.

    Parameters
    ----------
    path : Path
        MCAP file of ``beardyn simulate``, of the recorder node, or of ``simulate(..., record=...)``.
    namespace : str, optional
        Of the axlebox to read; by default the first one in the file.

    Raises
    ------
    InputError
        The file is absent, not MCAP, or holds not one usable message.
    """
    return read_run(path, namespace)


def monitor(
    run: Run | Path | str,
    algorithm: Algorithm = REFERENCE,
    *,
    bearing: Bearing | NamePlate | None = None,
    sensor: str = "",
    settings: MonitorSettings | None = None,
) -> Conclusion:
    """Let a monitor judge a run, as ``beardyn monitor`` does.

    Parameters
    ----------
    run : Run or Path
        A run or a recording: vibration of one accelerometer, shaft, load and temperature are used,
        and nothing else.
    algorithm : function, optional
        In place of the reference chain: a `Chain`, or a function like it.
    bearing : Bearing or NamePlate, optional
        What the name plate says; by default that of the scene, of a measured run the one it was read with.
    sensor : str, optional
        Accelerometer to listen to; by default the first, or the one that hears the bearing of a measured run.
    settings : MonitorSettings, optional

    Returns
    -------
    Conclusion
        The most frequent verdict, how many analyses agree, and one of them.

    Raises
    ------
    InputError
        The run has no vibration with a shaft angle, or does not say which bearing it is of.
    """
    run = run if isinstance(run, Run) else read_run(run)
    if bearing is None and run.scene_text:
        bearing = scene_from_text(run.scene_text, run.label).bearing
    elif bearing is None:
        known = mounted_in(run.measured, run.label)
        if len(known) != 1:
            several = (
                f"has the bearings {', '.join(each.label for each in known)}" if known else "does not say"
            )
            raise InputError(
                f"{run.label}: {several}{'' if known else ' which bearing it is of'}; give bearing"
            )
        bearing, sensor = known[0].plate, sensor or known[0].sensor
    return conclude(findings_of(run, bearing, algorithm, settings, sensor))
