"""Published temperatures next to the intervals that grease, seals and air leave."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Annotated as A

from beardyn_core.choice.heat_interval import HeatInterval, heat_interval
from beardyn_core.scene.scene import Scene
from evidence.heat.cases import HEALTHY, SPEEDS_KMH, rig_scene, scene_of
from evidence.heat.published import NTN_RISE
from evidence.tables import markdown
from evidence.validation.heat import FLEET, FLEET_LOAD


@dataclass(frozen=True)
class Published:
    """A published rise above the air, and the scene that it is ours of."""

    name: str
    part: A[str, "of the bearing or its box"]
    least: A[float, "[K]"]
    most: A[float, "[K]"]
    scene: Scene


def published() -> Iterator[Published]:
    """List what was measured on healthy axleboxes."""
    for place, speed, air, coolest, warmest in FLEET:
        scene = scene_of(HEALTHY, speed, force=(0.0, 0.0, FLEET_LOAD), ambient=air + 273.15)
        yield Published(
            f"high-speed train, {place}, {speed:.0f} km/h", "axlebox", coolest - air, warmest - air, scene
        )
    yield Published("rig of NTN, 2216 rpm", "cup", NTN_RISE, NTN_RISE, rig_scene(HEALTHY))


@cache
def at_speed(speed_kmh: float) -> HeatInterval:
    """Find the intervals of the healthy bearing at a speed."""
    return heat_interval(scene_of(HEALTHY, speed_kmh))


def intervals() -> str:
    """Tabulate the intervals of the healthy bearing, and published values next to those of their scenes."""
    rows = [
        (f"healthy, {speed:.0f} km/h", "axlebox", *_cells(at_speed(speed), "axlebox"), "", "")
        for speed in SPEEDS_KMH
    ]
    for each in published():
        found = heat_interval(each.scene)
        low, _, high = found.rise(each.part)
        measured = f"{each.least:.0f}" if each.least == each.most else f"{each.least:.0f} to {each.most:.0f}"
        inside = "inside" if low <= each.least and each.most <= high else "outside"
        rows.append((each.name, each.part, *_cells(found, each.part), measured, inside))
    head = ("", "part", "least [K]", "usual [K]", "most [K]", "measured [K]", "")
    return markdown(head, rows, "llrrrrl")


def _cells(found: HeatInterval, part: str) -> Iterator[str]:
    return (f"{value:.0f}" for value in found.rise(part))


def shares(speed_kmh: float) -> str:
    """Tabulate what each assumed input does to the axlebox."""
    found = at_speed(speed_kmh)
    rows = [
        (
            f"`{each.effect}.{each.option}`",
            *(f"{value:g}" if isinstance(value, float) else value for value in each.values),
            *(f"{one.rise('axlebox'):.0f}" for one in each.found),
        )
        for each in found.inputs
    ]
    return markdown(("input", "low", "high", "box at low [K]", "at high [K]"), rows, "lrrrr")
