"""The reference, a plain envelope spectrum and cepstrum pre-whitening over the same runs of a trial.

``python -m evidence.trial.rivals -o FILE``: every eleventh run of `default`, simulated once and judged by the
three monitors of docs/evidence/monitor_measured.md, to see whether the twin ranks them as measured records
do; ``python -m evidence.trial.page FOLDER --rivals FILE`` has it on the page.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_trial, trial_scene, with_choices
from beardyn_core.monitor.chain import FAULTS, MonitorSettings
from beardyn_core.monitor.streaming import Monitor, MonitorInput, run_monitor
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import HEALTHY, Cell
from beardyn_core.study.monitored_recording import WAITING, Finding, conclude
from beardyn_core.study.trial_result import Rate
from evidence.measured.run import METHODS
from evidence.runner import write_json

OURS, PLAIN = "ours", "CPW"
HEALTHY_BEARING = "healthy"  # a verdict; `HEALTHY` is the fault of such a bearing
_MOST_RAISED, _RAISED_BY = 40.0, 0.5  # [dB]
EVERY = 11  # no divisor of the 27 runs of a size: it walks through speeds, wheels and surfaces


@dataclass(frozen=True)
class Judged:
    """What one monitor says of one run."""

    method: str
    run: A[str, "key of its cell"]
    fault: A[str, "``none`` of a healthy bearing"]
    verdict: A[str, "of most analyses"]
    alarms: A[int, "analyses that call a part"]
    analyses: int
    called: A[list[tuple[str, float]], "verdict of each, and its score over the threshold, [dB]"]


def receive(scene: Scene, cell: Cell, interval: float) -> list[Judged]:
    """Simulate a run once and let every monitor judge it, with an analysis every ``interval`` [s]."""
    signals = [MonitorInput.of_block(block) for block in blocks(scene)]
    orders, count = fault_frequencies(scene.bearing), scene.bearing.roller_count
    judged = []
    for method, algorithm in METHODS.items():
        monitor = Monitor(orders, count, settings=MonitorSettings(interval=interval), algorithm=algorithm)
        found = [*run_monitor(monitor, signals), monitor.result()]
        called = [(each.verdict, each.score - each.threshold) for each in found if each.verdict != WAITING]
        judged.append(judge(Judged(method, cell.key, cell.fault, "", 0, len(called), called), 0.0))
    return judged


def judge(each: Judged, raised: float, method: str = "") -> Judged:
    """Judge a run by its analyses, with the threshold raised by so many decibels."""
    said = [HEALTHY_BEARING if name in FAULTS and over < raised else name for name, over in each.called]
    verdict = conclude([Finding(name, "", float(at)) for at, name in enumerate(said)]).verdict
    alarms = sum(name in FAULTS for name in said)
    return replace(each, method=method or each.method, verdict=verdict, alarms=alarms)


def as_seldom(judged: Sequence[Judged], method: str, other: str) -> tuple[float, list[Judged]]:
    """Raise the threshold of a method until it alarms in no more healthy runs than another one, [dB]."""
    own = [each for each in judged if each.method == method]
    allowed = _alarmed([each for each in judged if each.method == other])
    for raised in np.arange(0.0, _MOST_RAISED, _RAISED_BY).tolist():
        found = [judge(each, raised, f"{method}, threshold {raised:.1f} dB higher") for each in own]
        if _alarmed(found) <= allowed:
            return raised, found
    raise ValueError(f"{method} alarms more often than {other} however high its threshold is")


def _alarmed(judged: Sequence[Judged]) -> int:
    return sum(each.alarms > 0 for each in judged if each.fault == HEALTHY)


def table(judged: Sequence[Judged]) -> str:
    """Write what each monitor found, named wrongly and missed, and its false alarms, as a table."""
    lines = [
        "| monitor | right | another part | missed | healthy runs with a false alarm | analyses of them |",
        "|---|---|--:|--:|---|---|",
    ]
    _, quiet = as_seldom(judged, PLAIN, OURS)
    for method in dict.fromkeys(each.method for each in (*judged, *quiet)):
        own = [each for each in (*judged, *quiet) if each.method == method]
        faulty = [each for each in own if each.fault != HEALTHY]
        sound = [each for each in own if each.fault == HEALTHY]
        right = sum(each.verdict == each.fault for each in faulty)
        wrong = sum(each.verdict in FAULTS and each.verdict != each.fault for each in faulty)
        alarmed = Rate.of(sum(each.alarms > 0 for each in sound), len(sound))
        called = Rate.of(sum(each.alarms for each in sound), sum(each.analyses for each in sound))
        lines.append(
            f"| {method} | {_text(Rate.of(right, len(faulty)))} | {wrong} | {len(faulty) - right - wrong} | "
            f"{_text(alarmed)} | {_text(called)} |"
        )
    return "\n".join(lines)


def orders(judged: Sequence[Judged]) -> str:
    """Tell the order of the monitors by false alarms, and by what is missed, fewest first."""
    sound = [each for each in judged if each.fault == HEALTHY]
    missed = [each for each in judged if each.fault != HEALTHY and each.verdict not in FAULTS]
    alarms = {method: sum(each.alarms for each in sound if each.method == method) for method in METHODS}
    silent = {method: sum(each.method == method for each in missed) for method in METHODS}
    fewest = (", ".join(sorted(METHODS, key=counts.__getitem__)) for counts in (alarms, silent))
    return "Fewest false alarms first: {}. Fewest spalls missed first: {}.".format(*fewest)


def _text(rate: Rate) -> str:
    return (
        f"{rate.count}/{rate.total}, {100 * rate.value:.3g} % ({100 * rate.low:.2g} to {100 * rate.high:.3g})"
    )


def main() -> int:
    """Run, print and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="JSON")
    parser.add_argument("--trial", default="default", help="default `default`")
    parser.add_argument(
        "--every", type=int, default=EVERY, metavar="N", help=f"runs received, default {EVERY}"
    )
    parser.add_argument("--force", action="store_true", help="overwrite FILE")
    args = parser.parse_args()
    if args.output.exists() and not args.force:
        parser.error(f"{args.output} exists; --force overwrites it")
    trial = with_choices(load_trial(args.trial))
    cells = [cell for cell in trial.cells() if not cell.checks][:: args.every]
    judged: list[Judged] = []
    for number, cell in enumerate(cells, start=1):
        judged += receive(trial_scene(trial, cell), cell, trial.interval)
        said = ", ".join(f"{each.method} {each.verdict}" for each in judged[-len(METHODS) :])
        print(f"{number} of {len(cells)}: {cell.key}: {said}", flush=True)
        write_json(args.output, [asdict(each) for each in judged])
    print(table(judged))
    print(orders(judged))
    return 0


if __name__ == "__main__":
    sys.exit(main())
