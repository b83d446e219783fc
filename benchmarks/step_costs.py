"""Where the time of a step goes: stages, laminae, rollers."""

from __future__ import annotations

from dataclasses import replace
from statistics import median

from beardyn_core.choice import load_scene
from beardyn_core.config import load_effects
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.stage_clock import STAGES, StageClock
from benchmarks.runs import SETTLING_BLOCKS, Cell, Table, started, straight_line, take_turns

LAMINAE = (4, 8, 12, 20)
ROLLERS = (8, 12, 16, 20)
SURFACES = {
    "frictionless": "contact",
    "dry": "+ Coulomb friction",
    "standard": "+ film and mixed traction",
    "full": "every effect, laminae coupled",
}


def stages(blocks: int) -> Table:
    """Measure the stage clocks of runs with the standard and with every effect, medians over blocks."""
    times: list[dict[str, float]] = []
    for name in ("standard", "full"):
        scene = replace(load_scene("static_80kN", effects="standard"), effects=load_effects(name))
        twin = started(scene, blocks + SETTLING_BLOCKS)
        clocks = []
        for _ in range(blocks + SETTLING_BLOCKS):
            twin.stages = StageClock()
            twin.advance()
            clocks.append({each.stage: each.seconds for each in twin.stages.times()})
        steps = 512 * scene.numerics.steps_per_sample
        clocks = clocks[SETTLING_BLOCKS:]
        times.append(
            {stage: 1e6 * median(clock.get(stage, 0.0) for clock in clocks) / steps for stage in clocks[0]}
        )
    times = [{**found, "sum": sum(found.values())} for found in times]
    rows: list[tuple[Cell, ...]] = [
        (
            stage,
            *(value for found in times for value in (found.get(stage, 0.0), share(found, stage))),
        )
        for stage in (*STAGES, "sum")
        if any(stage in found for found in times)
    ]
    return Table(
        "stages",
        "Stages of a step, full tier, 80 kN, 6 laminae",
        ("stage", "standard us/step", "standard %", "full us/step", "full %"),
        rows,
        "contact to rings: shares of the kernel, measured in one step of 128 with the stages kept apart.",
    )


def share(times: dict[str, float], stage: str) -> float:
    """Compute the share of the whole, [%]."""
    return 100.0 * times.get(stage, 0.0) / times["sum"]


def laminae(turns: int) -> Table:
    """Fit a straight line of the step's time over the number of laminae, per set of effects."""
    base = load_scene("static_80kN", effects="standard")
    scenes = {
        f"{name} {count}": replace(
            base, effects=load_effects(name), numerics=replace(base.numerics, laminae=count)
        )
        for name in SURFACES
        for count in LAMINAE
    }
    timings = take_turns(scenes, turns)
    contacts = 2 * 2 * base.bearing.roller_count  # raceways, rows, rollers
    rows = []
    dearest = None
    for name, what in SURFACES.items():
        line = straight_line(
            [float(count) for count in LAMINAE], [timings[f"{name} {n}"].step_us() for n in LAMINAE]
        )
        cost = 1e3 * line.slope / contacts
        dearest = dearest or cost
        rows.append((name, what, cost, cost / dearest, line.offset, line.fit))
    return Table(
        "laminae",
        f"Cost of a lamina: step time over {', '.join(map(str, LAMINAE))} laminae",
        ("effects", "surface", "ns per lamina contact", "ratio", "us/step without laminae", "R^2"),
        rows,
        f"One lamina contact of one roller on one raceway; {contacts} contacts of each lamina per step. "
        "Coupled laminae cost more than linearly.",
    )


def rollers(turns: int) -> Table:
    """Step time over the number of rollers, the load of each kept."""
    base = load_scene("static_80kN", effects="standard")
    timings = take_turns({str(count): _with_rollers(base, count) for count in ROLLERS}, turns)
    line = straight_line([2.0 * n for n in ROLLERS], [timings[str(n)].step_us() for n in ROLLERS])
    rows = [
        (2 * n, timings[str(n)].step_us(), timings[str(n)].step_us() / (line.offset + 2 * n * line.slope))
        for n in ROLLERS
    ]
    return Table(
        "rollers",
        "Scaling in rollers, standard effects, 6 laminae",
        ("rollers", "us/step", "against the line"),
        rows,
        f"Line: {line.offset:.2f} us + {line.slope:.3f} us per roller, R^2 = {line.fit:.4f}.",
    )


def _with_rollers(scene: Scene, count: int) -> Scene:
    assert isinstance(scene.operation, ConstantOperation)
    share_of_load = count / scene.bearing.roller_count
    x, y, z = scene.operation.force
    force = (share_of_load * x, share_of_load * y, share_of_load * z)
    return replace(
        scene,
        bearing=replace(scene.bearing, roller_count=count),
        operation=replace(scene.operation, force=force),
    )
