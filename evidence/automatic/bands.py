"""What fast tiers miss of the third octaves: ``python -m evidence.automatic.bands``.

Runs scenes with what is chosen for them in each tier, prints a table and writes it into docs/effects_auto.md.
The rules of the automatic choice expect what is found here.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.choice import load_scene
from beardyn_core.choice.load import complete_scene, with_coupled_laminae
from beardyn_core.config import read_scene
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.study.measures import NOMINAL_BANDS, third_octave_levels
from evidence.pages import DOCS, write_section

SCENES = (
    *("smooth_run", "healthy_80", "healthy_140", "healthy_300", "freight_100", "wheel_flat", "cup_spall"),
    *("service_high_speed", "service_freight"),
)
TIERS = ("quasistatic", "lumped")
SECONDS, SETTLING = 2.3, 0.3
# bands from, to [Hz], and to which frequency vibration is asked for in the run that is compared
RANGES = {(31.5, 250): 1e3, (315, 400): 1e3, (500, 1000): 1e3, (1250, 5000): 5e3, (6300, 10_000): 10e3}
COUPLED = "`quasistatic`, coupled laminae"
UNDAMPED = "`quasistatic`, no creep"
PAGE = DOCS / "effects_auto.md"
TITLE, NEXT = "## Third octaves of the fast tiers\n", "## How good the estimates are\n"
HEAD = """
Written by `python -m evidence.automatic.bands`: {seconds:g} s of shipped scenes without noise of the sensor,
in `full` as chosen by default and in the fast tiers; the third octave in each range that is farthest off
that of `full`, all axes together, in dB. Columns to 1000 Hz are of what is chosen for vibration to 1 kHz, the
next of what is chosen for 5 kHz, the last of what is chosen for 10 kHz, as are the rows *coupled laminae* and
*no creep* (without `traction`).

| scene | tier | {ranges} |
|---|---|{rules}|
"""


def levels(scene: Scene) -> Float:
    """Run a scene and measure its third octaves, [dB]."""
    quiet = tuple(replace(sensor, noise_density=0.0, rate=25_600.0) for sensor in scene.sensors)
    simulation = start(replace(scene, sensors=quiet), SECONDS)
    blocks = simulation.blocks(simulation.twin.blocks_at_once)
    vibration = np.concatenate([block.acceleration[0] for block in blocks if len(block.acceleration)])
    return third_octave_levels(vibration[round(SETTLING * 25_600.0) :])


def worst(apart: Float, ranges: Iterable[tuple[float, float]] = tuple(RANGES)) -> list[str]:
    """Write the largest deviation in each range and where it is."""
    found = []
    for low, high in ranges:
        places = [index for index, band in enumerate(NOMINAL_BANDS) if low <= band <= high]
        place = max(places, key=lambda index: abs(float(apart[index])))
        found.append(f"{apart[place]:+.1f} at {NOMINAL_BANDS[place]:g}")
    return found


def row(name: str, what: str, cells: list[str]) -> str:
    """Write and print a row of the table."""
    text = f"| `{name}` | {what} | {' | '.join(cells)} |"
    print(text, flush=True)
    return text


def main() -> None:
    """Run, print and write."""
    rows = []
    for name in SCENES:
        reference = levels(load_scene(name, tier="full", effects="auto"))
        for tier in TIERS:
            chosen = {
                to: load_scene(name, tier=tier, effects="auto", vibration_to=to) for to in RANGES.values()
            }
            apart = {to: levels(scene) - reference for to, scene in chosen.items()}
            cells = [cell for span, to in RANGES.items() for cell in worst(apart[to], (span,))]
            rows.append(row(name, f"`{tier}`", cells))
        there = load_scene(name, tier="quasistatic", effects="auto", vibration_to=10e3)
        undamped = replace(there, effects=replace(there.effects, traction=None))
        rows.append(row(name, UNDAMPED, worst(levels(undamped) - reference)))
        coupled = with_coupled_laminae(read_scene(name, {("tier",): "quasistatic", ("effects",): "auto"}))
        assert coupled is not None
        rows.append(row(name, COUPLED, worst(levels(complete_scene(coupled)) - reference)))
    ranges = " | ".join(f"{low:g} to {high:g} Hz" for low, high in RANGES)
    head = HEAD.format(seconds=SECONDS - SETTLING, ranges=ranges, rules="|".join(["--:"] * len(RANGES)))
    text = TITLE + head + "\n".join(rows) + "\n\n"
    write_section(PAGE, TITLE, text, NEXT)


if __name__ == "__main__":
    main()
