"""Simulate a scene."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.announcements import announced_on_stderr
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import files_read, recording_problems

if TYPE_CHECKING:
    from beardyn_core.effects import EffectSet
    from beardyn_core.record.run import Run
    from beardyn_core.record.sinks import Sink
    from beardyn_core.scene.load import LoadHistory
    from beardyn_core.scene.scene import Scene
    from beardyn_core.sensors.block import Block
    from beardyn_core.sensors.summary import RunSummary


@announced_on_stderr()
def simulate(
    scene: str | Path | Mapping[str, Any] | Scene,
    *,
    tier: str | None = None,
    effects: str | Mapping[str, Any] | EffectSet | None = None,
    duration: float | None = None,
    laminae: int | None = None,
    seed: int | None = None,
    rings: str | None = None,
    snapshot_rate: float | None = None,
    record: Path | str | None = None,
    force: bool = False,
    progress: bool = False,
    **changes: Any,
) -> Run:
    """Run a scene as fast as this machine can, record it if asked to.

    Run a scene as fast as this machine can. The first run of a set of effects compiles its kernels, about a
    minute, and prints a line on standard error about it; they are kept on disk.

    Parameters
    ----------
    scene : str, Path, mapping or Scene
        Shipped scene or YAML file. Or what else `beardyn_core.scene` takes, whose other arguments can be
        given here too: ``faults=[...]``, ``end_play_mm=0.05``.
    tier : str, optional
        ``lumped``, ``quasistatic``, ``full`` or ``auto``; default the scene's.
    effects : str, mapping or EffectSet, optional
        Set or file of effects, or ``auto``; default the scene's. Or the effects themselves.
    duration : float, optional
        Simulated time, s; default the scene's.
    laminae : int, optional
        Slices (laminae) of each roller; default the scene's.
    seed : int, optional
        Seed of irregularity and noise; default the scene's.
    rings : str, optional
        Rings that bend (``elastic``) or not (``rigid``): the effect ``structure``; default that of the
        effects.
    snapshot_rate : float, optional
        Bodies and contacts a second, Hz; default the scene's, or 200. Allowed are 200 and its doubles up to
        12800. At 200 ``contacts.largest`` has the largest load of every step in between.
    record : Path, optional
        Record the run to this file; default no file. It is an MCAP file.
    force : bool
        Replace the file when it exists; default refuse.
    progress : bool
        Show a bar on standard error.

    Returns
    -------
    Run
        Kept in memory. Of a scene with ``axleboxes`` that of the first one; every one is in its ``boxes``, by
        name. Its ``status`` is a sentence, and a ``RuntimeWarning`` repeats it, when the model left its
        range of validity; the arrays end there.

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
    from beardyn_core.api.making import scene as make_scene
    from beardyn_core.config.content import files_of
    from beardyn_core.record.sinks import McapSink, MemorySink
    from beardyn_core.scene.scene import Scene
    from beardyn_core.study import desk_run

    asked = {"tier": tier, "effects": effects, "duration": duration, "laminae": laminae, "seed": seed}
    asked |= {"rings": rings, "snapshot_rate_Hz": snapshot_rate}
    asked |= changes
    untouched = isinstance(scene, Scene) and all(value is None for value in asked.values())
    with files_read() as inputs:
        made = scene if isinstance(scene, Scene) and untouched else make_scene(scene, **asked)  # type: ignore[arg-type]
    inputs += files_of(made)
    if record is not None and (problems := recording_problems("", Path(record), inputs=inputs, force=force)):
        raise InputError(problems)
    for doubt in made.doubts:
        warnings.warn(doubt, stacklevel=3)
    if made.axleboxes is not None:
        return _train(made, record, force, progress)
    memory = MemorySink()
    sinks: list[Sink] = [memory]
    if record is not None:
        sinks.append(McapSink(record, replace=force))
    with _bar(made.duration, progress) as advance:
        summary = desk_run.run(made, sinks, advance, life=False)
    if not summary.complete:
        warnings.warn(summary.status, RuntimeWarning, stacklevel=3)
    for sensor, count, total in summary.clipped:
        warnings.warn(
            f"the accelerometer {sensor} has clipped {count} of {total} samples; "
            "give it a larger range_m_per_s2",
            stacklevel=3,
        )
    load = None if memory.run is None else memory.run.load
    return memory.to_run(partial(_with_life, summary, made, load))


def _train(scene: Scene, record: Path | str | None, force: bool, progress: bool) -> Run:
    """Simulate all axleboxes of a scene; see `simulate`."""
    from beardyn_core.record.run import Run
    from beardyn_core.record.sinks import TrainSink
    from beardyn_core.study import train_run

    assert scene.axleboxes is not None
    pictures = scene.axleboxes.pictures
    sink = None if record is None else TrainSink(record, replace=force, pictures=pictures)
    boxes = train_run.start(scene)
    with _bar(scene.duration, progress) as shown:

        def advance(blocks: Mapping[str, Block]) -> None:
            if shown is not None and blocks:
                shown(next(iter(blocks.values())))

        done = train_run.advance(boxes, sink, keep=True, progress=advance)
    runs: dict[str, Run] = {}
    for name, summary in done.summaries.items():
        one = next(each for each in boxes if each.name == name)
        if not summary.complete:
            warnings.warn(f"{name}: {summary.status}", RuntimeWarning, stacklevel=4)
        whole_one = partial(_with_life, summary, one.scene, one.description.load)
        runs[name] = Run.of_blocks(one.kept, one.description, summary.status, whole_one, runs, name)
    return runs[boxes[0].name]


def _with_life(summary: RunSummary, scene: Scene, load: LoadHistory | None) -> RunSummary:
    """Add the rating life under the load until the end of the run; it can take longer than a short run."""
    from beardyn_core.record.run_summary import life_of

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
