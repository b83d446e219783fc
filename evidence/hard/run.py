"""The ways in which hard cases are run."""

from __future__ import annotations

import math
import os
import pickle
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.any_bearing import require_tapered
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from evidence.hard.case import WITHOUT_STARTS, HardCase
from evidence.hard.case_scene import history, load_of, scene_of
from evidence.hard.coarse_step import coarse_run
from evidence.hard.explicit_contact import step_roller
from evidence.hard.refinement import REPEATS, Change, Float, changes, changes_of_runs, displace
from evidence.hard.verdict import SKIPPED, Finding, Outcome, judged, over_starts
from evidence.hard.watch import Measures, Watch

CHECKPOINT_EVERY_S = 30.0
# keys that a later version of the configuration brings
_COMING = ("missing_rollers", "rows")


# Beyond it blocks of the fast tiers are looked at several at a time: looking takes ten times what they do.
LONG_S = 60.0
# A nanometre of end play apart. The bearing is chaotic: a verdict that one start gives may be chance.
STARTS = 5


def run_case(case: HardCase, checkpoint: Path | None = None, starts: int = STARTS) -> Outcome:
    """Run a case from several starts and judge it; half the step is tried from the first one.

    Parameters
    ----------
    case : HardCase
    checkpoint : Path, optional
        Where a long case keeps how far its first start is.
    starts : int
        A nanometre of end play apart each.
    """
    began = time.perf_counter()
    runs: dict[str, Callable[[HardCase, Path | None], Finding]] = {
        "run": _run,
        "end": _run,
        "refused scene": _refused_scene,
        "refused load": _refused_load,
        "restart": _restart,
        "coarse step": _coarse_step,
        "explicit": _explicit,
    }
    coming = [key for key in _COMING if key in case.changes and not _known_key(case)]
    if coming:
        return Outcome(case.name, SKIPPED, (f"the scene key {coming[0]!r} is not there yet",))
    found = [judged(case, runs[case.run_as](case, checkpoint), 0.0)]
    for start in range(1, 1 if case.run_as in WITHOUT_STARTS else starts):
        other = replace(case, start=start, refined=False, long=False)
        found.append(judged(other, runs[case.run_as](other, None), 0.0))
    return over_starts(case, found, time.perf_counter() - began)


def _known_key(case: HardCase) -> bool:
    try:
        scene_of(case)
    except InputError as error:
        return not any("unknown key" in problem for problem in error.problems)
    return True


def _run(case: HardCase, checkpoint: Path | None) -> Finding:
    """Run a case, and again with half the step when that is asked for."""
    try:
        scene = scene_of(case)
        watch = _watched(scene, load_of(case, scene), case.duration, checkpoint if case.long else None)
    except _EndedError as ended:
        return Finding(ended.watch.measures(), sentence=str(ended))
    except (InputError, ValidityError) as error:
        return Finding(Measures(), sentence=str(error), refused=True)
    if not case.refined:
        return Finding(watch.measures())
    load = load_of(case, scene)
    try:
        return Finding(watch.measures(), _refined(scene, load, case.duration, watch.statistics()))
    except _EndedError as ended:
        return Finding(watch.measures(), sentence=f"with half the step or displaced rollers: {ended}")


def _refined(scene: Scene, load: LoadHistory, duration: float, first: Float) -> tuple[Change, ...]:
    """Measure what half the step changes; run further only where the first two differ."""

    def statistics(steps_per_sample: float, number: int) -> Float:
        stepped = replace(scene, numerics=replace(scene.numerics, steps_per_sample=steps_per_sample))
        return _watched(stepped, load, duration, None, number).statistics()

    usual = scene.numerics.steps_per_sample
    coarse, fine = [first], [statistics(2 * usual, 0)]
    found = changes(first, fine[0])
    if all(change.inside for change in found):
        return found
    for number in range(1, REPEATS):
        coarse.append(statistics(usual, number))
        fine.append(statistics(2 * usual, number))
    return changes_of_runs(coarse, fine)


class _EndedError(Exception):
    """A run left its validity; carries what was seen until then."""

    def __init__(self, sentence: str, watch: Watch) -> None:
        super().__init__(sentence)
        self.watch = watch


def _watched(
    scene: Scene, load: LoadHistory, duration: float, checkpoint: Path | None, number: int = 0
) -> Watch:
    """Run to the end; go on from the checkpoint when there is one. ``number``: as in `displace`."""
    twin, watch = Twin(scene), Watch(scene)
    if checkpoint is not None and checkpoint.exists():
        snapshot, watch = pickle.loads(checkpoint.read_bytes())
        twin.restore(snapshot)
    else:
        twin.start(load)
        displace(twin, number)
    kept = time.monotonic()
    at_once = twin.blocks_at_once if duration > LONG_S else 1
    while (left := round(duration * 1e9 / twin.block_ns) - watch.end_ns // twin.block_ns) > 0:
        before = twin.snapshot() if scene.tier == "full" else None
        try:
            block = twin.advance(min(at_once, left))
        except ValidityError as error:
            last = error.block
            assert isinstance(last, Block)
            watch.see(twin, last, before)
            raise _EndedError(str(error), watch) from None
        watch.see(twin, block, before)
        if checkpoint is not None and time.monotonic() - kept > CHECKPOINT_EVERY_S:
            keep(checkpoint, (twin.snapshot(), watch))
            kept = time.monotonic()
    return watch


def keep(path: Path, what: Any) -> None:
    """Write a file that is whole or not there."""
    beside = path.with_name(f"{path.name}.part")
    beside.write_bytes(pickle.dumps(what))
    os.replace(beside, path)


def _refused_scene(case: HardCase, _checkpoint: Path | None) -> Finding:
    try:
        scene_of(case)
    except InputError as error:
        return Finding(Measures(), sentence=str(error), refused=True)
    return Finding(Measures())


def _refused_load(case: HardCase, _checkpoint: Path | None) -> Finding:
    """Run well, and again with the points of the case sent after the first quarter."""
    scene = scene_of(case)
    blocks = round(case.duration * 1e9 / Twin.block_ns)
    good = load_of(replace(case, load=()), scene)
    undisturbed, disturbed = Twin(scene), Twin(scene)
    cut = int(np.searchsorted(good.time_ns, blocks // 4 * Twin.block_ns)) + 1
    undisturbed.start(good)
    disturbed.start(good.part(0, cut))
    watch, differing = Watch(scene), 0
    for index in range(blocks):
        if index == blocks // 4:
            bad = history(case.load)
            later = replace(bad, time_ns=bad.time_ns + good.time_ns[cut])
            if disturbed.feed(later):
                return Finding(watch.measures())
            if not disturbed.feed(good.part(cut, len(good))):
                return Finding(watch.measures(), sentence="the good load was refused after the bad one")
        before = undisturbed.snapshot()
        block = undisturbed.advance()
        watch.see(undisturbed, block, before)
        differing += differences(disturbed.advance(), block)
    measures = replace(watch.measures(), differing=differing)
    return Finding(measures, sentence=disturbed.load.reason, refused=True)


def _restart(case: HardCase, _checkpoint: Path | None) -> Finding:
    scene = scene_of(case)
    twin, watch = Twin(scene), Watch(scene)
    twin.start(load_of(case, scene))
    blocks = round(case.duration * 1e9 / twin.block_ns)
    kept, straight = b"", []
    for index in range(blocks):
        before = twin.snapshot()
        if index == blocks // 2:
            kept = pickle.dumps(before)
        block = twin.advance()
        watch.see(twin, block, before)
        if index >= blocks // 2:
            straight.append(block)
    fresh = Twin(scene)
    for again in (twin, fresh):
        again.restore(pickle.loads(kept))
    differing = sum(differences(again.advance(), block) for block in straight for again in (twin, fresh))
    return Finding(replace(watch.measures(), differing=differing))


def differences(one: Block, two: Block) -> int:
    """Count the numbers of two blocks that are not the same bits."""
    count = 0
    others = two.arrays()
    for name, a in one.arrays().items():
        b = others.get(name)
        if b is None or a.shape != b.shape:
            count += 1
        else:
            count += int(np.count_nonzero(~((a == b) | ((a != a) & (b != b)))))
    return count


def _coarse_step(case: HardCase, _checkpoint: Path | None) -> Finding:
    return Finding(coarse_run(scene_of(case), case.load[0], case.factor))


def _explicit(case: HardCase, _checkpoint: Path | None) -> Finding:
    """Step explicitly by the case's length; compare the mean with that of a step ten times shorter."""
    bearing = require_tapered(scene_of(case).bearing, "explicit steps of one roller")
    found = step_roller(bearing, case.factor)
    right = step_roller(bearing, min(0.1 * case.factor, 1e-7))
    return Finding(
        Measures(
            simulated=len(found.friction) * found.step,
            status=int(found.status),
            finite=bool(np.isfinite(found.friction).all()) and math.isfinite(found.speed),
            chatter_index=found.index,
            cage_speed=found.speed,
            cage_speed_ratio=found.speed / right.speed,
            mean_force=float(found.friction.mean()),
            peak_force=float(np.abs(found.friction).max()),
        )
    )
