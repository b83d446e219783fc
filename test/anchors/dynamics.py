"""Dynamic runs of shipped scenes; each scene runs once."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from beardyn_core.config import load_scene
from beardyn_core.study.desk_run import RunSummary, run
from test.anchors.anchor import Anchor

SANTOS = "Santos 2017, mean ring reaction"


@lru_cache
def summary(name: str) -> RunSummary:
    found = run(load_scene(name))
    assert found.status == "complete", found.status
    return found


def carried() -> float:
    bearing = load_scene("static_5kN").bearing
    weight = 9.80665 * 2 * (bearing.roller_count * bearing.roller_mass + bearing.cage.mass)
    return summary("static_5kN").mean_force[2] + weight


@lru_cache
def small_step() -> RunSummary:
    """One second at 80 kN with steps of 0.6 us."""
    scene = load_scene("static_80kN")
    return run(replace(scene, duration=1.0, numerics=replace(scene.numerics, steps_per_sample=64)))


def residual(found: RunSummary) -> float:
    assert found.energy_residual is not None
    return 100.0 * found.energy_residual


ANCHORS = (
    Anchor(
        "D1",
        "mean force on the cup under 5 kN, with the weight of rollers and cages",
        5000.0,
        "N",
        SANTOS,
        carried,
        tolerance=0.01,
        slow=True,
    ),
    Anchor(
        "D27",
        "cage speed over the epicyclic one, 80 kN",
        1.0,
        "",
        "ADORE.jl claims 0.2 % under load",
        lambda: sum(summary("static_80kN").cage_speed_ratio) / 2,
        tolerance=0.005,
        slow=True,
    ),
    Anchor(
        "D27",
        "cage speed over the epicyclic one, 5 kN",
        1.0,
        "",
        "ADORE.jl claims 0.2 % under load",
        lambda: sum(summary("static_5kN").cage_speed_ratio) / 2,
        tolerance=0.005,
        slow=True,
    ),
    Anchor(
        "D31",
        "energy residual at the production step, 80 kN",
        0.0,
        "%",
        "ADORE.jl: below 0.02 %",
        lambda: residual(summary("static_80kN")),
        absolute=0.02,
        slow=True,
    ),
    Anchor(
        "D31",
        "energy residual at the production step, 5 kN",
        0.0,
        "%",
        "ADORE.jl: below 0.02 %",
        lambda: residual(summary("static_5kN")),
        absolute=0.02,
        slow=True,
    ),
    Anchor(
        "D31",
        "energy residual over a second at a step of 0.6 us, 80 kN",
        0.0,
        "%",
        "ADORE.jl: below 0.02 %",
        lambda: residual(small_step()),
        absolute=0.02,
        slow=True,
    ),
)
