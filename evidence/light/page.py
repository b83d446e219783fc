"""Write docs/light.md and its picture: ``python -m evidence.light.page``; with sets as arguments of these."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt

from beardyn_core.bearing.life import dynamic_rating
from beardyn_core.choice import load_scene
from evidence.light.grid import (
    AUTO,
    FAST,
    FAST_TURNS,
    LARGEST_RATIO,
    LOADS_KN,
    SETS,
    SPEEDS_RPM,
    Point,
    run_automatic,
    run_grid,
)
from evidence.pages import DOCS, PICTURES, save_small

PAGE = DOCS / "light.md"
PICTURE = PICTURES / "light.png"
MINIMUM_SHARE = 0.02
TOLD_FROM = 1.01
COLOURS = 32

HEAD = """# Light loads

Written by `python -m evidence.light.page`. Speed of the cages over that of pure rolling, mean of the last 0.5
of 1.2 s, in tier `quasistatic` of {turns:g} turns of the shaft at least: `{bearing}` without play, cup held,
70 °C, grease {supply}; {count} runs.

![Slip of the cages against load]({picture})

Catalogues ask for a load of at least {minimum_share:g} C on a roller bearing so that it does not skid (SKF,
2018, Rolling bearings, "Minimum load"): {minimum:.0f} kN here. Above it no set slips by more than
{above:.1%}; below it `full` does at high speed, and `quasistatic`, with the same effects, does not: its
rollers move in their pockets, and do not skid. {verdict}
"""
AHEAD = """
Ahead of rolling by more than {limit:.1%}:
{listed}.
A dry rib drives rollers that hang on the cup between rib and cup, and they push the cage; `standard`, whose
rib is lubricated, shows none of it. Above 1 % the status says so.
"""
CHOSEN = """
## Effects that are chosen

What a scene gets that names no effects, chosen for each point, where most is left out: {rows}. From
1165 rpm on the rib is always lubricated, so nothing of `dry` is among them. Tier `lumped` rolls without slip.
"""
MEASURED = """
## Beside measured slip

No source found gives slip in per cent with load, speed, oil and the inside of a bearing. What abstracts say
of rigs stands on the [validation page](validation.md) beside runs at 2 kN, a tenth of the minimum load: slip
rises with speed and with oil, and preloaded rows do not slip, as measured on NU215 (Dawoud, Beitler, Schwarze
2022). It falls as the oil warms in the gearbox of a wind turbine (Guo and Keller 2020), where it came to 60 %
in the loaded zone, and **rises in ours**. That page has the slip over the load at 3000 rpm, with the share
that Harris (1966) found below a few hundred newtons.
"""


def write(points: list[Point], chosen: list[Point]) -> None:
    """Write page and picture."""
    scene = load_scene("static_5kN", effects="full")
    rating = dynamic_rating(scene.bearing).radial
    minimum = MINIMUM_SHARE * rating * 1e-3
    draw(points, minimum, PICTURE)
    ahead = [each for each in points if not each.holds]
    above = max(abs(1.0 - each.ratio) for each in points if each.load_kn >= minimum)
    film = scene.effects.film
    head = HEAD.format(
        bearing=scene.bearing.name,
        supply="" if film is None else film.supply,
        count=len(points),
        picture=PICTURE.relative_to(DOCS),
        minimum_share=MINIMUM_SHARE,
        minimum=minimum,
        above=above,
        turns=FAST_TURNS,
        verdict=f"None runs back{'' if ahead else f', none ahead by more than {LARGEST_RATIO - 1.0:.1%}'}.",
    )
    listed = ",\n".join(
        f"`{each.effects}` at {each.load_kn:g} kN and {each.speed_rpm:g} rpm ({each.ratio:.4f}"
        f"{', told' if each.told else ''})"
        for each in ahead
    )
    text = head + (AHEAD.format(limit=LARGEST_RATIO - 1.0, listed=listed) if ahead else "")
    told = "; ".join(f"{each.ratio:.4f} at {each.load_kn:g} kN and {each.speed_rpm:g} rpm" for each in chosen)
    PAGE.write_text(text + CHOSEN.format(rows=told) + MEASURED + tables(points), encoding="utf-8")


def tables(points: list[Point]) -> str:
    """Write one table for each set, speeds against loads."""
    found = {(each.effects, each.speed_rpm, each.load_kn): each for each in points}
    lines = []
    for effects in (*SETS, FAST):
        lines += [f"\n## `{effects}`\n", "| rpm | " + " | ".join(f"{q:g} kN" for q in LOADS_KN) + " |"]
        lines.append("|---" * (len(LOADS_KN) + 1) + "|")
        for speed in SPEEDS_RPM:
            row = [f"{found[effects, speed, load].ratio:.4f}" for load in LOADS_KN]
            lines.append(f"| {speed:g} | " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"


def draw(points: list[Point], minimum: float, target: Path) -> None:
    """Draw the slip against the load."""
    shown = (*SETS, FAST)
    figure, axes = plt.subplots(1, len(shown), figsize=(12.0, 3.6), sharey=True, layout="constrained")
    for axis, effects in zip(axes, shown, strict=True):
        for speed in SPEEDS_RPM:
            line = [each for each in points if (each.effects, each.speed_rpm) == (effects, speed)]
            slip = [100.0 * (1.0 - each.ratio) for each in line]
            axis.plot([each.load_kn for each in line], slip, "o-", ms=3, label=f"{speed:g} rpm")
        axis.axvline(minimum, color="0.5", ls="--", lw=1)
        axis.set(xscale="log", yscale="symlog", title=effects, xlabel="radial load [kN]")
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("slip of the cages [%]")
    axes[0].legend(fontsize=8)
    axes[-1].text(minimum, axes[-1].get_ylim()[1], " 0.02 C", va="top", fontsize=8, color="0.4")
    figure.savefig(target, dpi=110)
    plt.close(figure)
    save_small(target, target, COLOURS)


def main(sets: list[str]) -> int:
    """Run the grid and write the page; of named sets alone, the others as they stand on the page."""
    anew = tuple(sets) or (*SETS, FAST)
    points = [] if not sets else [each for each in on_page() if each.effects not in anew]
    chosen = chosen_on_page() if sets else list(run_automatic())
    for point in run_grid(anew):
        points.append(point)
        name = f"{point.effects:9} {point.load_kn:6g} kN {point.speed_rpm:6g} rpm"
        print(f"{name} {point.ratio:.4f} {point.told}", flush=True)
    write(points, chosen)
    return 0


def on_page() -> list[Point]:
    """Read the points of the page; none of them may be one of which the status tells."""
    points, effects = [], ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## `"):
            effects = line[4:-1]
        elif effects and re.match(r"\| \d", line):
            speed, *ratios = (float(cell) for cell in line.strip("| ").split("|"))
            points += [Point(effects, q, speed, each, 0) for q, each in zip(LOADS_KN, ratios, strict=True)]
    if any(each.ratio > TOLD_FROM for each in points):
        raise SystemExit("the page has cages of which the status tells: run the whole grid")
    return points


def chosen_on_page() -> list[Point]:
    """Read the points whose effects were chosen."""
    found = re.findall(r"(\d\.\d+) at ([\d.]+) kN and (\d+) rpm(?=[;.])", PAGE.read_text(encoding="utf-8"))
    return [Point(AUTO, float(load), float(speed), float(ratio), 0) for ratio, load, speed in found]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
