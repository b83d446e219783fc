"""Follow drifts of axleboxes in the tier `full`: a load that steps, a spall that grows, warming, none.

``python -m evidence.follow.drift --keep FOLDER`` simulates every drift, follows it by the estimator that is
shipped, prints a table with the lag of each and writes it to docs/evidence/estimator.md. The descriptors of a
stretch are kept in FOLDER, so that another estimator is judged without another simulation.
"""

from __future__ import annotations

import argparse
import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import write_noun
from beardyn_core.config import load_bearing
from beardyn_core.config.yaml_text import scene_text
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.follow.descriptors import describe, names_of
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.estimator_choice import estimator_for
from beardyn_core.follow.following import WAITING, Followed
from beardyn_core.follow.growth import GrowthLaw
from beardyn_core.follow.inference import stretches_of
from beardyn_core.follow.run_stretches import follower_of
from beardyn_core.follow.shipped import shipped_estimators
from beardyn_core.sensors.labels import HEALTHY
from evidence.pages import REPORTS, write_section
from evidence.runner import kept_arrays

PAGE = REPORTS / "estimator.md"
TITLE, NEXT = "## Drifts\n", "## One train, followed\n"
SCENE, BEARING, SPARE = "service_high_speed", "HS130x230", 1.03  # of the length of a stretch
LENGTH_MM, DEPTH_UM = 25.0, 100.0


def shipped_estimator() -> Estimator:
    """Read the shipped estimator of the bearing, that of three axes."""
    return estimator_for(load_bearing(BEARING), known=shipped_estimators())


class Piece(NamedTuple):
    """Some stretches during which nothing changes."""

    stretches: int
    keys: A[dict[str, Any], "of the scene"]
    truth: A[dict[str, float], "by quantity, SI"]
    mileage: A[float, "at its begin, [m]"] = 0.0
    time: A[float, "at its begin, [s]"] = 0.0
    anew: A[bool, "another recording begins"] = False
    condition: str = HEALTHY


def load_step() -> list[Piece]:
    """Make a lateral load that becomes another one within a recording."""
    return [
        Piece(4, {"lateral_kN": load, "seed": seed}, {"lateral_load": 1e3 * load}, time=begin)
        for load, seed, begin in ((-5.0, 1, 0.0), (12.0, 2, 6.2))
    ]


def growing_spall() -> list[Piece]:
    """Make a spall of the cup that grows by the law over recordings of two stretches."""
    law, widths = GrowthLaw(), np.array([3.0, 4.5, 6.0, 8.0, 10.0, 12.0])
    area = 1e-6 * LENGTH_MM * widths
    ways = [float(law.distance(area[:1], area[k : k + 1], np.array([law.rate]))[0]) for k in range(len(area))]
    return [
        Piece(
            2,
            {"width_mm": float(width), "seed": k + 1},
            {"width": 1e-3 * float(width)},
            way,
            10.0 * k,
            anew=k > 0,
            condition="cup",
        )
        for k, (width, way) in enumerate(zip(widths, ways, strict=True))
    ]


def warming() -> list[Piece]:
    """Make a healthy bearing that warms from 30 to 90 degrees Celsius within an hour."""
    truth = {"lateral_load": 5e3, "end_play": 1e-4}
    return [
        Piece(1, {"lateral_kN": 5.0, "temperature_C": warm, "seed": k + 1}, truth, time=900.0 * k)
        for k, warm in enumerate((30.0, 45.0, 60.0, 75.0, 90.0))
    ]


def sound_mileage() -> list[Piece]:
    """Make a healthy bearing over 200 000 km, on another track each time."""
    return [Piece(2, {"seed": k + 1}, {"end_play": 1e-4}, 4e7 * k, 10.0 * k, anew=k > 0) for k in range(6)]


DRIFTS = {
    "load step": load_step,
    "growing spall": growing_spall,
    "warming": warming,
    "healthy over mileage": sound_mileage,
}


def received_of(piece: Piece, estimator: Estimator) -> Float:
    """Simulate a piece and describe its stretches, shape [stretch, descriptor]."""
    operation: dict[str, Any] = write_noun(bd.scene(SCENE))["operation"]
    operation["lateral_force_kN"] = piece.keys.get("lateral_kN", 0.0)
    changes: dict[str, Any] = {"seed": piece.keys["seed"], "operation": operation}
    if "width_mm" in piece.keys:
        size = {"width_mm": piece.keys["width_mm"], "length_mm": LENGTH_MM, "depth_um": DEPTH_UM}
        changes["faults"] = [{"on": piece.condition, "row": 0, **size}]
    if "temperature_C" in piece.keys:
        changes["temperature_C"] = piece.keys["temperature_C"]
    run = bd.simulate(SCENE, duration=piece.stretches * estimator.stretch * SPARE, **changes)
    found = stretches_of(run, estimator)
    return np.stack([describe(each, estimator.orders, estimator.plate, estimator.axes) for each in found])


def digest_of(pieces: Sequence[Piece], estimator: Estimator) -> str:
    """Give what the descriptors of a drift depend on: simulator, pieces, how an estimator receives."""
    received = (estimator.axes, estimator.rate, estimator.stretch, estimator.plate, names_of(estimator.axes))
    scene = scene_text(bd.scene(SCENE))
    digest = hashlib.sha256(repr((simulator_digest(), tuple(pieces), received, scene)).encode())
    digest.update(Path(__file__).read_bytes())
    return digest.hexdigest()[:12]


def rows_of(name: str, pieces: Sequence[Piece], estimator: Estimator, kept: Path | None) -> list[Float]:
    """Simulate a drift, or take what an earlier go has kept of it."""
    path = None if kept is None else kept / f"{name.replace(' ', '_')}-{digest_of(pieces, estimator)}.npz"
    names = [f"piece_{k}" for k in range(len(pieces))]
    found = kept_arrays(
        path, lambda: {each: received_of(piece, estimator) for each, piece in zip(names, pieces, strict=True)}
    )
    return [found[each] for each in names]


def followed(pieces: Sequence[Piece], rows: Sequence[Float], estimator: Estimator) -> list[list[Followed]]:
    """Follow a drift: the steps of every piece."""
    follower = follower_of(load_bearing(BEARING), estimator)
    found = []
    for piece, received in zip(pieces, rows, strict=True):
        if piece.anew:
            follower.begin()
        steps = [
            follower.take(row, piece.time + estimator.stretch * (k + 1), piece.mileage + 80.0 * (k + 1))
            for k, row in enumerate(received)
        ]
        found.append(steps)
    return found


def lag(pieces: Sequence[Piece], found: Sequence[Sequence[Followed]], name: str, first: int) -> int | None:
    """Count the stretches of late pieces until the truth is inside of its interval and stays; none: never."""
    held = [
        bool(each.intervals) and each.intervals[-1][0] <= piece.truth[name] <= each.intervals[-1][1]
        for piece, steps in zip(pieces[first:], found[first:], strict=True)
        for each in (step.estimates[name] for step in steps)
    ]
    if not held or not held[-1]:
        return None
    misses = [k for k, each in enumerate(held) if not each]
    return misses[-1] + 1 if misses else 0


def told(
    name: str, pieces: Sequence[Piece], found: Sequence[Sequence[Followed]], stretch: float
) -> list[str]:
    """Write the rows of a drift: one for each number that has a truth."""
    every = [step for steps in found for step in steps]
    conditions = [steps[-1].estimates.part for steps in found]
    named = sum(
        part is not None and part.condition == piece.condition
        for part, piece in zip(conditions, pieces, strict=True)
    )
    healths = ", ".join(dict.fromkeys(each.health for each in every))
    first = 1 if name == "load step" else 0
    lines = []
    for quantity in pieces[-1].truth:
        end = every[-1].estimates[quantity]
        show = end.quantity.text
        truth = " to ".join(dict.fromkeys(show(each.truth[quantity]) for each in (pieces[0], pieces[-1])))
        late = lag(pieces, found, quantity, first)
        known = "never" if late is None else f"{late} stretches, {late * stretch:.1f} s"
        ends = (
            f"{show(end.intervals[-1][0])} to {show(end.intervals[-1][1])}" if end.intervals else end.reason
        )
        lines.append(
            f"| {name} | {quantity.replace('_', ' ')} | {truth} | {show(end.value)}, {ends} | {known} | "
            f"{named} of {len(pieces)} | {healths} |"
        )
    return lines


def false_growth(found: Sequence[Sequence[Followed]]) -> str:
    """Say whether a healthy bearing was said to be spalled, and whether its rate of growth moved."""
    every = [step for steps in found for step in steps]
    rates = np.array([step.rate[0] for step in every])
    wrong = sum(step.health not in (WAITING, HEALTHY) for step in every)
    return (
        f"Healthy over mileage: {wrong} of {len(every)} stretches have another health than `healthy` or "
        f"`waiting`, and the rate of growth is {rates[-1] / rates[0]:.2f} times what it was at first."
    )


def section(rows: Sequence[str], growth: str) -> str:
    """Write the section of the page."""
    head = (
        f"{TITLE}\nWritten by `python -m evidence.follow.drift`: one run of each in the tier `full`, of "
        f"`{SCENE}`, followed by the shipped estimator. *Lag*: stretches until the truth is inside of its "
        "interval of 90 % and stays there."
    )
    table = [
        "| drift | number | truth | at the end, 90 % interval | lag | condition named | health |",
        "|---|---|---|---|---|---|---|",
        *rows,
    ]
    return "\n".join([head, "", *table, "", growth, "", ""])


def main(argv: list[str] | None = None) -> int:
    """Simulate, follow, print and write."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.drift", description=__doc__)
    parser.add_argument(
        "--keep", metavar="DIR", type=Path, help="keep what was received here, and take it from here"
    )
    args = parser.parse_args(argv)
    estimator = shipped_estimator()
    rows, growth = list[str](), ""
    for name, pieces in ((each, make()) for each, make in DRIFTS.items()):
        found = followed(pieces, rows_of(name, pieces, estimator, args.keep), estimator)
        of_drift = told(name, pieces, found, estimator.stretch)
        rows += of_drift
        growth = false_growth(found)  # of the last one, which is sound
        print("\n".join(of_drift), flush=True)
    write_section(PAGE, TITLE, section(rows, growth), NEXT)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
