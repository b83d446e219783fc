"""Play a train with a twin in the tier `full`, follow it from vibration and shaft alone, and draw both.

``make follow``, or ``python -m evidence.follow.demo -o FOLDER``.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import beardyn_core as bd
from beardyn_core.api.following import Following
from beardyn_core.base.edge import write_noun
from beardyn_core.base.outputs import file_problems
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.quantities import BY_NAME

TRAIN = "service_high_speed_cup"  # a spalled cup, full tier, a box that rings, drive, track and knocks
BESIDE = "service_high_speed"  # what the follower knows of the axlebox: a healthy bearing in it
LATERAL_LOAD_KN, END_PLAY_MM, SECONDS = 8.0, 0.15, 15.2
WIDTH_MM, LENGTH_MM, DEPTH_UM = 6.0, 25.0, 100.0
TRUTH = {
    "lateral_load": 1e3 * LATERAL_LOAD_KN,
    "end_play": 1e-3 * END_PLAY_MM,
    "width": 1e-3 * WIDTH_MM,
    "length": 1e-3 * LENGTH_MM,
    "depth": 1e-6 * DEPTH_UM,
}
LABELS = {
    "lateral_load": "lateral load",
    "end_play": "end play",
    "width": "width of the spall",
    "length": "length of the spall",
    "depth": "depth of the spall",
}


def played() -> bd.Run:
    """Simulate the train, whose numbers the follower is not told."""
    operation: dict[str, Any] = write_noun(bd.scene(TRAIN))["operation"]
    operation["lateral_force_kN"] = LATERAL_LOAD_KN
    spall = {"on": "cup", "row": 0, "width_mm": WIDTH_MM, "length_mm": LENGTH_MM, "depth_um": DEPTH_UM}
    return bd.simulate(
        TRAIN, operation=operation, end_play_mm=END_PLAY_MM, faults=[spall], duration=SECONDS, progress=True
    )


def table(found: Following) -> str:
    """Tell truth and estimate of each number."""
    last = found.steps[-1]
    part = last.estimates.part
    lines = [
        f"{'truth':32} {'estimate':>10}  90 % interval",
        f"{'condition cup':32} {part.condition if part else ''}",
    ]
    for name, truth in TRUTH.items():
        each = last.estimates[name]
        show = each.quantity.text
        told = each.reason
        if np.isfinite(each.value):
            low, high = each.intervals[-1]
            missed = "" if low <= truth <= high else ", missed"
            told = f"{show(each.value):>10}  {show(low)} to {show(high)}{missed}"
        lines.append(f"{name + ' ' + show(truth):32} {told}")
    return "\n".join(lines)


def draw(found: Following, path: Path) -> None:
    """Draw estimates with intervals over time beside the truth, and third octaves beside the twin."""
    names = [name for name in TRUTH if name in found.steps[0].names]
    figure = Figure(figsize=(10.0, 2.0 * len(names) + 3.5), layout="constrained")
    axes = figure.subplots(len(names) + 1, 1)
    time_s = [each.time for each in found.steps]
    for axis, name in zip(axes, names, strict=False):
        quantity = BY_NAME[name]
        scale = quantity.factor
        for level, shade in zip(reversed(range(len(LEVELS))), (0.2, 0.4), strict=True):
            ends = np.array(
                [(each.estimates[name].intervals or ((np.nan, np.nan),) * 2)[level] for each in found.steps]
            )
            axis.fill_between(
                time_s, scale * ends[:, 0], scale * ends[:, 1], color="tab:blue", alpha=shade, lw=0
            )
        axis.plot(time_s, [scale * each.estimates[name].value for each in found.steps], "o-", ms=3)
        axis.plot(
            time_s, [scale * each.received[name].value for each in found.steps], "x", color="gray", ms=4
        )
        axis.plot(time_s, [scale * TRUTH[name]] * len(time_s), color="black", ls="--", lw=1)
        axis.set_ylabel(f"{LABELS[name]}\n[{quantity.shown}]")
    axes[0].set_title(
        "estimates with 50 and 90 % intervals; crosses: one stretch alone; dashed: the truth, which the "
        "follower does not know",
        fontsize=10,
    )
    axes[-2].set_xlabel("time [s]")
    if found.residual is not None:
        both, last = found.residual, len(found.residual.axes) - 1
        axes[-1].semilogx(
            both.middles, both.measured[last], "o-", ms=3, label="measured (simulated in tier full)"
        )
        axes[-1].semilogx(both.middles, both.twin[last], "s-", ms=3, label="twin (tier quasistatic)")
        low, high = both.twin[last] - both.tolerance[last], both.twin[last] + both.tolerance[last]
        axes[-1].fill_between(both.middles, low, high, color="tab:orange", alpha=0.2, lw=0, label="tolerance")
        axes[-1].set_xlabel("third octave [Hz]")
        axes[-1].set_ylabel(f"vibration {both.axes[last]}\n[dB re 1 m/s²]")
        axes[-1].legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main(argv: list[str] | None = None) -> int:
    """Run the demonstration."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.demo", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path("follow.png"), help="picture to write")
    parser.add_argument("--force", action="store_true", help="replace the picture when it exists")
    args = parser.parse_args(argv)
    if problems := file_problems("--output", args.output, force=args.force, ending=".png"):
        parser.error("; ".join(problems))
    began = time.perf_counter()
    found = bd.follow(played(), twin=BESIDE)
    print("\n".join(each.sentence for each in found.steps))
    print("\n" + table(found))
    if found.residual is not None:
        print(f"{100 * found.residual.explained:.0f} % of the third octaves are as those of the twin")
    draw(found, args.output)
    print(f"{args.output} is written, {time.perf_counter() - began:.0f} s in all")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
