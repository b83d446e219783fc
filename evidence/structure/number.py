"""How many modes are enough: statics, answer of a sensor, a run with a spall, and what a step costs."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.effects import ModalStructure
from beardyn_core.experiments import core_count
from beardyn_core.experiments.loop import all_of
from beardyn_core.rail.build import load_history
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.build import load_zone
from beardyn_core.structure.modes import Modes
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of, table_path
from beardyn_core.structure.table import read_table, table_text
from beardyn_core.study.measures import BAND_CENTRES, third_octave_levels
from beardyn_core.twin import Twin
from evidence.hard.watch import Measures, Watch
from evidence.standard import standard_scene
from evidence.structure.study import BOX, unit

HIGHEST = (1000.0, 2000.0, 3000.0, 4000.0, 6000.0, 8000.0, 10000.0, 12800.0)  # the last one: all modes
FINE = np.geomspace(200.0, 8000.0, 800)  # [Hz]
DURATION, SETTLED = 0.3, 0.1  # of a run, and what of it is not looked at, [s]
LOWEST_BAND = 200.0  # of those compared, [Hz]: 0.2 s have fewer than nine lines in a lower one
COUNTS = (0, 16, 50, None)  # modes of a step that is timed; ``None``: all
_TIMED = 0.2  # [s]
_NUDGE = 1e-9  # of the end play, [m]


@dataclass(frozen=True)
class Kept:
    """What is left of a box with the free modes up to a frequency, beside all its modes."""

    highest: A[float, "[Hz]"]
    free: A[int, "free modes kept"]
    modes: A[int, "free and residual modes"]
    yielding: A[float, "change of what the raceway yields under a load zone, share"]
    response: A[float, "largest change of the sensor's answer to 8 kHz, [dB]"]
    levels: A[Float, "shape [band], third octaves of the run, [dB]"]
    energy: A[float, "residual of the energy audit of the run, share of the losses"]
    momentum: A[float, "largest residual of the momentum in a block, share of load times time"]


def scene_of(table: Path | str, highest: float | None = None) -> Scene:
    """Put ``cup_spall`` into a box, with a sensor that has no noise."""
    scene = standard_scene("cup_spall", tier="full")
    effects = replace(scene.effects, structure=ModalStructure(str(table), highest))
    modes = modes_of_effects(effects)
    assert modes is not None
    return replace(
        scene,
        effects=effects,
        mounting=mounting_of(modes, scene.mounting, scene.bearing),
        sensors=tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors),
    )


class Measurement(NamedTuple):
    """What is received of a run, and what it has kept of energy and momentum."""

    levels: A[Float, "shape [band], third octaves of the sensor, [dB]"]
    measures: Measures


def received(scene: Scene) -> Measurement:
    """Run a scene, with a watch over energy and momentum."""
    twin, watch, parts = Twin(scene), Watch(scene), []
    twin.start(load_history(scene.operation, scene.mounting, DURATION, scene.seed))
    while twin.next_end_ns <= DURATION * 1e9:
        before = twin.snapshot()
        block = twin.advance()
        watch.see(twin, block, before)
        if block.start_ns >= SETTLED * 1e9:
            parts.append(block.vibration[0].acceleration)
    return Measurement(third_octave_levels(np.concatenate(parts), scene.sensors[0].rate), watch.measures())


def kept() -> list[Kept]:
    """Leave out free modes above each of `HIGHEST`."""
    modes = read_table(table_path(BOX))
    zone, top = load_zone(len(modes.reads)), unit(modes, "axlebox_top", 2)
    yields, answer = modes.yielding(zone, zone), np.abs(modes.response(top, zone, FINE))
    found = []
    runs = all_of(received, [scene_of(BOX, highest) for highest in HIGHEST], workers=core_count())
    for highest, (levels, measures) in zip(HIGHEST, runs, strict=True):
        fewer = modes.below(highest)
        assert measures.energy_residual is not None
        assert measures.momentum_residual is not None
        ratio = np.abs(fewer.response(top, zone, FINE)) / answer
        found.append(
            Kept(
                highest,
                fewer.free_count,
                len(fewer.frequency),
                fewer.yielding(zone, zone) / yields - 1.0,
                float(np.max(np.abs(20.0 * np.log10(ratio)))),
                levels,
                measures.energy_residual,
                measures.momentum_residual,
            )
        )
    return found


def chance() -> Float:
    """Run with all modes and the end play a nanometre wider, third octaves [dB]: what luck alone changes."""
    scene = scene_of(BOX)
    return received(replace(scene, end_play=scene.end_play + _NUDGE)).levels


def rigid() -> Float:
    """Run in the same box without modes, third octaves [dB]."""
    return received(without(scene_of(BOX))).levels


def without(scene: Scene) -> Scene:
    """Make the box of a scene rigid."""
    return replace(scene, effects=replace(scene.effects, structure=None))


def apart(one: Float, other: Float, highest: float = np.inf) -> float:
    """Give the largest difference of levels in bands from `LOWEST_BAND` to `highest` [Hz], [dB]."""
    low, high = np.searchsorted(BAND_CENTRES, (0.99 * LOWEST_BAND, 1.01 * highest))
    return float(np.max(np.abs(one - other)[low:high]))


def first(modes: Modes, count: int) -> Modes:
    """Keep the first modes, free ones before residual ones."""
    return replace(
        modes,
        frequency=modes.frequency[:count],
        damping_ratio=modes.damping_ratio[:count],
        raceway=modes.raceway[:count],
        seats={name: shape[:count] for name, shape in modes.seats.items()},
        free_count=min(count, modes.free_count),
    )


def costs(counts: Sequence[int | None] = COUNTS, rounds: int = 3) -> list[tuple[int, float]]:
    """Time steps with numbers of modes in turn: number, and median of the processor time of a step, [us]."""
    modes = read_table(table_path(BOX))
    with tempfile.TemporaryDirectory() as folder:
        scenes = []
        for count in counts:
            path = Path(folder) / f"first_{count}.csv"
            path.write_text(table_text(modes if not count else first(modes, count)), encoding="utf-8")
            scene = scene_of(path)
            scenes.append(without(scene) if count == 0 else scene)
        taken = np.array([[_timed(scene) for scene in scenes] for _ in range(rounds)])
    numbers = [len(modes.frequency) if count is None else count for count in counts]
    return list(zip(numbers, map(float, np.median(taken, axis=0)), strict=True))


def _timed(scene: Scene) -> float:
    twin = Twin(scene)
    twin.warm()
    twin.start(load_history(scene.operation, scene.mounting, _TIMED, scene.seed))
    twin.advance()
    steps, began = 0, time.process_time()
    while twin.next_end_ns <= _TIMED * 1e9:
        twin.advance()
        steps += len(twin.step_signals)
    return 1e6 * (time.process_time() - began) / steps
