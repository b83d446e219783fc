"""Write docs/evidence/light.md and its picture: ``python -m evidence.light.page``; or of named sets."""

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
from evidence.pages import PICTURES, REPORTS, save_small, write_page
from evidence.tables import markdown

PAGE = REPORTS / "light.md"
PICTURE = PICTURES / "light.png"
MINIMUM_SHARE = 0.02
TOLD_FROM = 1.01
COLOURS = 32
TITLES = {FAST: f"tier {FAST}, effects all"}


def write(points: list[Point], chosen: list[Point]) -> None:
    """Write page and picture."""
    scene = load_scene("static_5kN", effects="all")
    rating = dynamic_rating(scene.bearing).radial
    minimum = MINIMUM_SHARE * rating * 1e-3
    draw(points, minimum, PICTURE)
    film = scene.effects.film
    values = {
        "bearing": scene.bearing.name,
        "supply": "" if film is None else film.supply,
        "count": len(points),
        "picture": f"../pictures/{PICTURE.name}",
        "minimum_share": MINIMUM_SHARE,
        "minimum": minimum,
        "above": max(abs(1.0 - each.ratio) for each in points if each.load_kn >= minimum),
        "turns": FAST_TURNS,
        "limit": LARGEST_RATIO - 1.0,
        "listed": [
            f"`{each.effects}` at {each.load_kn:g} kN and {each.speed_rpm:g} rpm ({each.ratio:.4f}"
            f"{', told' if each.told else ''})"
            for each in points
            if not each.holds
        ],
        "chosen": "; ".join(
            f"{each.ratio:.4f} at {each.load_kn:g} kN and {each.speed_rpm:g} rpm" for each in chosen
        ),
        "tables": {effects: table(points, effects) for effects in (*SETS, FAST)},
    }
    write_page(__file__, PAGE, values)


def table(points: list[Point], effects: str) -> str:
    """Write the table of a set, speeds against loads."""
    found = {(each.speed_rpm, each.load_kn): each.ratio for each in points if each.effects == effects}
    rows = [(f"{speed:g}", *(f"{found[speed, load]:.4f}" for load in LOADS_KN)) for speed in SPEEDS_RPM]
    return markdown(("rpm", *(f"{load:g} kN" for load in LOADS_KN)), rows)


def draw(points: list[Point], minimum: float, target: Path) -> None:
    """Draw the slip against the load."""
    shown = (*SETS, FAST)
    figure, axes = plt.subplots(1, len(shown), figsize=(11.0, 3.6), sharey=True, layout="constrained")
    for axis, effects in zip(axes, shown, strict=True):
        for speed in SPEEDS_RPM:
            line = [each for each in points if (each.effects, each.speed_rpm) == (effects, speed)]
            slip = [100.0 * (1.0 - each.ratio) for each in line]
            axis.plot([each.load_kn for each in line], slip, "o-", ms=3, label=f"{speed:g} rpm")
        axis.axvline(minimum, color="0.5", ls="--", lw=1)
        axis.set(
            xscale="log",
            yscale="symlog",
            title=TITLES.get(effects, f"tier full, effects {effects}"),
            xlabel="radial load [kN]",
        )
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("slip of the cages [%]")
    axes[0].legend(fontsize=8)
    axes[-1].annotate(
        "0.02 C", (minimum, 0.97), xycoords=("data", "axes fraction"), ha="right", va="top", fontsize=8
    )
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
