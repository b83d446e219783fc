"""Dynamic runs of shipped scenes; each scene runs once."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from beardyn_core.study.desk_run import RunSummary, run
from evidence.standard import standard_scene
from evidence.validation.anchor import Anchor, Finding, Trend

SANTOS = "Santos 2017, mean ring reaction"


@lru_cache
def summary(name: str) -> RunSummary:
    """Run a shipped scene to its end, once."""
    found = run(standard_scene(name))
    assert found.status == "complete", found.status
    return found


def carried() -> float:
    """Return the mean force on the cup under 5 kN with the weight of rollers and cages added, [N]."""
    bearing = standard_scene("static_5kN").bearing
    weight = 9.80665 * 2 * (bearing.roller_count * bearing.roller_mass + bearing.cage.mass)
    return summary("static_5kN").mean_force[2] + weight


@lru_cache
def small_step() -> RunSummary:
    """Run one second at 80 kN with steps of 0.6 us."""
    scene = standard_scene("static_80kN")
    return run(replace(scene, duration=1.0, numerics=replace(scene.numerics, steps_per_sample=64)))


def residual(found: RunSummary) -> float:
    """Return the energy residual of a run, [%]."""
    assert found.energy_residual is not None
    return 100.0 * found.energy_residual


ANCHORS = (
    Anchor(
        "mean force",
        "mean force on the cup under 5 kN, with the weight of rollers and cages",
        5000.0,
        "N",
        SANTOS,
        carried,
        tolerance=0.01,
        slow=True,
    ),
    Anchor(
        "cage speed",
        "cage speed over the epicyclic one, 80 kN",
        1.0,
        "",
        "ADORE.jl claims 0.2 % under load",
        lambda: sum(summary("static_80kN").cage_speed_ratio) / 2,
        tolerance=0.005,
        slow=True,
    ),
    Anchor(
        "cage speed",
        "cage speed over the epicyclic one, 5 kN",
        1.0,
        "",
        "ADORE.jl claims 0.2 % under load",
        lambda: sum(summary("static_5kN").cage_speed_ratio) / 2,
        tolerance=0.005,
        slow=True,
    ),
    Anchor(
        "energy",
        "energy residual at the production step, 80 kN",
        0.0,
        "%",
        "ADORE.jl: below 0.02 %",
        lambda: residual(summary("static_80kN")),
        absolute=0.02,
        slow=True,
    ),
    Anchor(
        "energy",
        "energy residual at the production step, 5 kN",
        0.0,
        "%",
        "ADORE.jl: below 0.02 %",
        lambda: residual(summary("static_5kN")),
        absolute=0.02,
        slow=True,
    ),
    Anchor(
        "energy",
        "energy residual over a second at a step of 0.6 us, 80 kN",
        0.0,
        "%",
        "ADORE.jl: below 0.02 %",
        lambda: residual(small_step()),
        absolute=0.02,
        slow=True,
    ),
)

SANTOS_S = (24 * 3600.0, 8 * 3600.0, 9.5 * 3600.0)
HORIZON_S = 0.03
SERVICE = ("static_5kN", "static_80kN", "smooth_run")


def faster_than_santos_2017() -> Finding:
    """Time the case of Santos (2017), a quarter turn of the cage under 5 kN, on one processor core."""
    found = run(replace(standard_scene("static_5kN"), duration=HORIZON_S))
    best = min(SANTOS_S) / HORIZON_S
    ratio = found.wall_time / found.duration
    return Finding(
        ratio < best,
        f"{HORIZON_S:g} s take {1e3 * found.wall_time:.0f} ms, {ratio:.2g} s a simulated second; Santos "
        f"(2017) needed 8 to 24 h, {best:.2g} to {max(SANTOS_S) / HORIZON_S:.2g} s.",
    )


def service_slip() -> Finding:
    """Return the largest slip of a cage in runs under service load."""
    slips = {name: max(abs(1.0 - ratio) for ratio in summary(name).cage_speed_ratio) for name in SERVICE}
    return Finding(
        max(slips.values()) < 0.01,
        "Cage slip " + ", ".join(f"{100.0 * slip:.2f} % in {name}" for name, slip in slips.items()) + ".",
    )


TRENDS = (
    Trend(
        "run time",
        "0.03 s of its case take less than its 8 to 24 hours",
        "Santos 2017, run times of three cases",
        faster_than_santos_2017,
    ),
    Trend(
        "cage slip",
        "cage slip in service is mostly below 1 %",
        "cage slip found in published data sets, up to 4 % in a 6203",
        service_slip,
    ),
)
