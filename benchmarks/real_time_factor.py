"""Real-time factor: simulated time over wall time on one core, medians over blocks that take turns."""

from __future__ import annotations

import math
from dataclasses import replace

from beardyn_core.choice import load_scene
from beardyn_core.physics.tiers.step_choice import choose_steps
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIER_NAMES, TIERS
from benchmarks.runs import Table, Timing, measure_alone, take_turns

SETS = ("standard", "full", "dry", "frictionless")
SCENES = ("smooth_run", "cup_spall", "cone_spall", "static_5kN")


def tiers_and_effects(turns: int) -> Table:
    """Time every tier with every shipped set of effects, steady 80 kN; and finer laminae."""
    scenes: dict[str, Scene] = {}
    for tier in reversed(TIER_NAMES):
        for name in SETS:
            scenes[f"{tier} {name}"] = load_scene("static_80kN", tier=tier, effects=name)
    for name in ("standard", "full"):
        for laminae in (6, 20):
            scene = load_scene("static_80kN", effects=name, laminae=laminae)
            label = f"full {name}" if laminae == 6 else f"full {name}, {laminae} laminae"
            scenes[label] = scene
            numerics = replace(scene.numerics, steps_per_sample=chosen_steps(scene))
            scenes[f"{label}, chosen step"] = replace(scene, numerics=numerics)
    table = _table(
        "real_time_factor",
        "Real-time factor by tier and set of effects, 80 kN, each tier with its own step",
        take_turns(scenes, turns),
        "full standard",
    )
    alone = measure_alone(scenes, max(2, turns // 8))
    at_once = [TIERS[scenes[str(row[0])].tier].blocks_at_once for row in table.rows]
    return replace(
        table,
        columns=(*table.columns, "RTF alone", "RTF alone, desk", "blocks in one"),
        rows=[(*row, *alone[str(row[0])][:2], count) for row, count in zip(table.rows, at_once, strict=True)],
        note=(
            f"RTF and ratios: {len(scenes)} runs in turn, a block of 20 ms each, so that every block finds "
            "its data driven out of the caches by the others, as several axleboxes on one core would. RTF "
            "alone: stretches of a quarter of a second of one run, in blocks of 20 ms as in the node. Desk: "
            "the same with as many blocks in one as a run without a recording takes. Medians of wall time."
        ),
    )


def chosen_steps(scene: Scene) -> float:
    """Return the step of `auto` for the scene when its vibration to 10 kHz is asked for."""
    operation = scene.operation
    assert isinstance(operation, ConstantOperation)
    load, speed = math.hypot(operation.force[0], operation.force[2]), operation.speed
    return choose_steps(
        scene.bearing, (load, load), (speed, speed), scene.effects, laminae=scene.numerics.laminae,
        end_play=scene.end_play, mounting=scene.mounting,
    ).steps_per_sample  # fmt: skip


def fast_tiers(turns: int) -> Table:
    """Time the fast tiers with cup held and suspended, and with a fault."""
    scenes = {
        f"{tier} {name}": load_scene(name, tier=tier, effects="standard")
        for tier in ("lumped", "quasistatic")
        for name in ("static_80kN", "smooth_run", "cup_spall")
    }
    found = measure_alone(scenes, max(3, turns // 4))
    return Table(
        "fast_tiers",
        "Real-time factor of the fast tiers, each run by itself",
        ("run", "steps a sample", "RTF alone", "RTF alone, desk", "RTF alone, desk, all looked at"),
        [(name, scenes[name].numerics.steps_per_sample, *factors) for name, factors in found.items()],
        "Poses, twists and contacts of the rollers are worked out when they are first used, for "
        "example by a recording; the last column includes that at every snapshot.",
    )


def scenes(turns: int) -> Table:
    """Time shipped scenes with the standard effects."""
    found = {name: load_scene(name, effects="standard") for name in SCENES}
    return _table("scenes", "Real-time factor of shipped scenes", take_turns(found, turns), SCENES[0])


def _table(name: str, title: str, timings: dict[str, Timing], reference: str) -> Table:
    rows = [
        (
            each,
            timing.twin.scene.numerics.laminae,
            timing.real_time_factor(),
            timing.step_us(),
            timing.ratio_to(timings[reference]),
        )
        for each, timing in timings.items()
    ]
    columns = ("run", "laminae", "RTF", "kernel us/step", f"time against {reference}")
    return Table(name, title, columns, rows)


def standard_alone(turns: int) -> Table:
    """Time the full tier with standard effects, for a comparison."""
    timings = take_turns({"full standard": load_scene("static_80kN", effects="standard")}, turns)
    return _table("standard", "Real-time factor, standard effects", timings, "full standard")
