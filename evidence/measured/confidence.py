"""How often verdicts are right, by what they rest on: the confidence of the monitor is set and judged here.

``python -m evidence.measured.confidence --cwru DIR --mfpt DIR --hit DIR`` prints the weights of
`beardyn_core.monitor.chain.confidence`, set on all machines, and writes docs/evidence/confidence.md with its
picture, on which every machine is judged with weights that are set on the others.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.optimize import minimize
from scipy.stats import binomtest

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.measured.stated_speed import UNCERTAINTY
from beardyn_core.monitor.chain import FAULTS, REFERENCE, MonitorSettings, Stretch
from beardyn_core.monitor.chain.confidence import PART, WEIGHTS, Grounds, confidence_of
from beardyn_core.monitor.chain.verdict import HEALTHY, UNEXPLAINED
from evidence.measured.cases import HIT, MFPT, PLATES, Listening, Record, listenings, records
from evidence.measured.wrong_inputs import orders_of
from evidence.pages import PICTURES, REPORTS, render, save_small
from evidence.runner import KeptResults

PAGE, PICTURE = REPORTS / "confidence.md", PICTURES / "confidence.png"
KINDS = (PART, HEALTHY, UNEXPLAINED)
KIND_WORDS = {PART: "a part", HEALTHY: "healthy", UNEXPLAINED: "unexplained"}
ERRORS = (-6, -4, -2, 2, 4, 6)  # of the stated speed, [%]
OTHERS = ("6203", "6204", "6206")
REVOLUTIONS, SHORT, LONGEST_S = 60.0, 20.0, 20.0
INPUTS = ("right", "speed", "bearing")
SHARES = {"right": 0.5, "speed": 0.25, "bearing": 0.25}  # of the inputs, assumed
PENALTY = 0.1  # on the squares of the weights but the first, in bearings
SURE = 0.9
FOLDS = 5
EDGES = (0.0, 0.5, 0.7, 0.8, 0.9, 0.95, 1.0)
# effect of each term of `Grounds` on the confidence: more than none, less than none, not used
_SIGNS = {
    PART: (0, 1, 1, 1, -1, -1),
    HEALTHY: (0, -1, -1, None, None, None),
    UNEXPLAINED: (0, 1, 1, 1, None, None),
}


@dataclass(frozen=True)
class Answer:
    """A verdict on a stretch of a record, with what it rests on."""

    machine: A[str, "rig or end of a rig"]
    bearing: A[str, "the same of several records of one bearing"]
    inputs: A[str, "one of `INPUTS`: all right, or which of them is wrong"]
    faulty: A[str, "part, '' of a healthy bearing"]
    loud_neighbour: A[bool, "another bearing of the machine is faulty"]
    verdict: str
    grounds: A[Grounds | None, "``None``: it cannot tell"]

    @property
    def kind(self) -> str:
        """Kind of the verdict, one of `KINDS`; another where it cannot tell."""
        return PART if self.verdict in FAULTS else self.verdict

    @property
    def is_right(self) -> bool:
        """Whether the verdict is true.

        ``unexplained`` is, where something strikes and the inputs leave the right part out.
        """
        if self.kind == PART:
            return self.verdict == self.faulty
        if self.kind == HEALTHY:
            return not self.faulty
        return self.loud_neighbour if not self.faulty else self.inputs != "right"


def analyse(
    received: Listening,
    first: int,
    revolutions: float,
    orders: FaultFrequencies,
    count: int,
    error: float,
    uncertainty: float,
) -> list[Any]:
    """Analyse a stretch from a sample on, the stated speed off by an error: verdict and grounds."""
    seconds = min(revolutions / received.shaft_frequency, LONGEST_S)
    samples = min(len(received.acceleration) - first, round(seconds * received.rate))
    turns_a_sample = received.shaft_frequency * (1.0 + error) / received.rate
    turned = np.asarray(2.0 * np.pi * turns_a_sample * np.arange(samples), np.float64)
    stretch = Stretch(received.rate, received.acceleration[first : first + samples], turned, np.nan, 0)
    result = REFERENCE(stretch, orders, count, MonitorSettings(speed_uncertainty=uncertainty))
    return [result.verdict, None if result.grounds is None else list(result.grounds)]


def answers(record: Record) -> list[list[Any]]:
    """Analyse a record with right and wrong inputs; each is a list of the fields of `Answer`."""
    found = []
    for received in listenings(record):
        if record.group == MFPT:
            machine, bearing = MFPT, record.name.rpartition("_")[0]
        elif record.group == HIT:
            machine, _, name = record.name.partition("/")
            machine, bearing = f"HIT-SM, {machine}", name.rpartition("_")[0]
        else:
            machine = "CWRU"
            bearing = f"{record.part} {record.diameter} {record.clock}"
        # a healthy bearing at the other end stays the same, whatever is faulty
        bearing = bearing if received.part else "healthy"
        name = f"{machine} {received.end} {bearing}"
        loud = bool(record.part) and not received.part
        for inputs, answer in _each(received):
            found.append([machine, name, inputs, received.part, loud, *answer])
    return found


def _each(received: Listening) -> Iterator[tuple[str, list[Any]]]:
    own = (received.plate.frequencies, received.plate.roller_count)
    last = max(0, len(received.acceleration) - round(REVOLUTIONS / received.shaft_frequency * received.rate))
    for first in sorted({0, last // 2, last}):
        yield "right", analyse(received, first, REVOLUTIONS, *own, 0.0, UNCERTAINTY)
    yield "right", analyse(received, 0, SHORT, *own, 0.0, UNCERTAINTY)
    yield "right", analyse(received, 0, REVOLUTIONS, *own, 0.0, 0.0)
    for error in ERRORS:
        yield "speed", analyse(received, 0, REVOLUTIONS, *own, error / 100.0, UNCERTAINTY)
    others = set(OTHERS) - {received.plate.name}
    if (
        not received.part and received.record.part
    ):  # by the data of the bearing at the other end its fault is right
        others -= set(PLATES.values())
    for name in sorted(others):
        yield "bearing", analyse(received, 0, REVOLUTIONS, *orders_of(name), 0.0, UNCERTAINTY)


def weights_of(several: Sequence[Answer]) -> Float:
    """Weigh answers: inputs by `SHARES`, healthy bearings as faulty ones, and bearings alike."""
    here = Counter((bool(each.faulty), each.inputs, each.bearing) for each in several)
    bearings = defaultdict(set)
    for each in several:
        bearings[bool(each.faulty), each.inputs].add(each.bearing)
    share = {(faulty, inputs): 0.5 * SHARES[inputs] for faulty, inputs in bearings}
    weight = [
        share[bool(each.faulty), each.inputs]
        / len(bearings[bool(each.faulty), each.inputs])
        / here[bool(each.faulty), each.inputs, each.bearing]
        for each in several
    ]
    return np.asarray(weight, np.float64)


def fit(kind: str, several: Sequence[Answer]) -> tuple[float, ...]:
    """Fit the weights of a kind of verdict: a logistic regression whose terms keep their sign.

    References
    ----------
    Platt (1999), Probabilistic outputs for support vector machines, Advances in Large Margin Classifiers: the
    targets, so that no few bearings make a verdict certain.
    """
    weight = weights_of(several)
    kept = [index for index, each in enumerate(several) if each.kind == kind and each.grounds is not None]
    terms = np.array([several[index].grounds.terms() for index in kept])  # type: ignore[union-attr]
    right = np.array([several[index].is_right for index in kept], float)
    bearings = len({several[index].bearing for index in kept})
    counts = [
        len({several[index].bearing for index in kept if several[index].is_right == is_right})
        for is_right in (True, False)
    ]
    target = np.where(right > 0.0, (counts[0] + 1.0) / (counts[0] + 2.0), 1.0 / (counts[1] + 2.0))
    weight = weight[kept] / weight[kept].sum() * bearings
    signs = _SIGNS[kind]

    def loss(values: Float) -> float:
        argument = terms @ values
        each = np.logaddexp(0.0, argument) - target * argument
        return float(weight @ each + 0.5 * PENALTY * np.sum(values[1:] ** 2))

    bounds = [
        (0.0, 0.0) if sign is None else (None, None) if not sign else (0.0, None) if sign > 0 else (None, 0.0)
        for sign in signs
    ]
    found = minimize(loss, np.zeros(len(signs)), bounds=bounds, method="L-BFGS-B")
    return tuple(round(float(each), 2) + 0.0 for each in found.x)


def kept(found: Sequence[Sequence[Any]]) -> list[Answer]:
    """Read answers as `answers` lists them."""
    return [Answer(*[*said, grounds and Grounds(*grounds)]) for *said, grounds in found]


def fitted(several: Sequence[Answer]) -> dict[str, tuple[float, ...]]:
    """Fit the weights of all kinds of verdicts that there are."""
    there = {each.kind for each in several if each.grounds is not None}
    return {kind: fit(kind, several) for kind in KINDS if kind in there}


def fold_of(several: Sequence[Answer], *, by_machine: bool) -> list[str]:
    """Name for each answer the part that it is judged in: its machine, or one of `FOLDS` sets of bearings."""
    if by_machine:
        return [each.machine for each in several]
    place = {name: index % FOLDS for index, name in enumerate(sorted({each.bearing for each in several}))}
    return [str(place[each.bearing]) for each in several]


def judged(several: Sequence[Answer], *, by_machine: bool = False) -> Float:
    """Give every answer the confidence by weights that are set on the other parts, shape [answer]."""
    found, folds = np.full(len(several), np.nan), fold_of(several, by_machine=by_machine)
    for fold in sorted(set(folds)):
        weights = fitted([each for each, other in zip(several, folds, strict=True) if other != fold])
        for index, each in enumerate(several):
            if folds[index] == fold:
                found[index] = confidence_of(each.verdict, each.grounds, weights)
    return found


def draw(several: Sequence[Answer], confidence: Float, path: Path = PICTURE) -> None:
    """Draw how often verdicts were right over their confidence."""
    figure = Figure(figsize=(6.4, 4.6), dpi=100, layout="constrained")
    axes = figure.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0], color="0.6", linewidth=1.0, label="as stated")
    for kind, marker in zip(KINDS, "os^", strict=True):
        rows = [each for each in calibration(several, confidence, kind) if each.bearings]
        mean, right = [each.stated for each in rows], [each.right for each in rows]
        low = [each.right - each.low for each in rows]
        high = [each.high - each.right for each in rows]
        axes.errorbar(mean, right, yerr=[low, high], marker=marker, capsize=3, label=KIND_WORDS[kind])
    axes.set_xlabel("confidence that the monitor states")
    axes.set_ylabel("share of verdicts that are right")
    axes.set_title("Confidence, judged on bearings that it was not set on", fontsize=10)
    axes.set_xlim(0.0, 1.02)
    axes.set_ylim(0.0, 1.05)
    axes.grid(True, alpha=0.3)
    axes.legend(loc="lower right")
    figure.savefig(path, dpi=100, format="png")
    save_small(path, path, 64)


@dataclass(frozen=True)
class Bin:
    """Verdicts of a range of confidence."""

    kind: str
    begin: float
    end: float
    stated: A[float, "mean confidence"]
    right: A[float, "share that is right, bearings weighed alike"]
    low: A[float, "of the 90 % interval of that share, over bearings"]
    high: float
    verdicts: int
    bearings: int


def calibration(several: Sequence[Answer], confidence: Float, kind: str) -> list[Bin]:
    """Compare confidence with the share of right verdicts in every range of `EDGES`."""
    weight = weights_of(several)
    found = []
    for begin, end in pairwise(EDGES):
        here = [
            index
            for index, each in enumerate(several)
            if each.kind == kind and begin <= confidence[index] < (end if end < 1.0 else np.inf)
        ]
        chosen = [several[index] for index in here]
        right = np.array([each.is_right for each in chosen], float)
        bearings = sorted({each.bearing for each in chosen})
        if not here:
            found.append(Bin(kind, begin, end, np.nan, np.nan, np.nan, np.nan, 0, 0))
            continue
        share = float(np.average(right, weights=weight[here]))
        # of bearings: records of one are no independent samples, and those of a large weight count for most
        each_weight = [
            sum(weight[index] for index in here if several[index].bearing == name) for name in bearings
        ]
        count = max(1, round(sum(each_weight) ** 2 / sum(one**2 for one in each_weight)))
        interval = binomtest(round(share * count), count).proportion_ci(0.9, method="wilson")
        stated = float(np.average(confidence[here], weights=weight[here]))
        found.append(
            Bin(kind, begin, end, stated, share, interval.low, interval.high, len(here), len(bearings))
        )
    return found


def text(several: Sequence[Answer], confidence: Float, counts: str) -> str:
    """Write the page."""
    harsh = judged(several, by_machine=True)
    bins = [each for kind in KINDS for each in calibration(several, confidence, kind) if each.bearings]
    found = fitted(several)
    shipped = [[KIND_WORDS[kind], *(f"{each:g}" for each in found[kind])] for kind in KINDS if kind in found]
    machines = sorted({each.machine for each in several})
    values = {
        "counts": counts,
        "uncertain": 100.0 * UNCERTAINTY,
        "errors": ", ".join(f"{each:+d}" for each in ERRORS),
        "shares": SHARES,
        "bins": [
            (
                KIND_WORDS[each.kind],
                f"{each.begin:g} to {each.end:g}",
                f"{each.stated:.2f}",
                f"{each.right:.2f}",
                f"{each.low:.2f} to {each.high:.2f}",
                each.verdicts,
                each.bearings,
            )
            for each in bins
        ],
        "sure": [
            (*row, *harsh_row[1:])
            for row, harsh_row in zip(_sure(several, confidence), _sure(several, harsh), strict=True)
        ],
        "healthy": len({each.bearing for each in several if not each.faulty}),
        "weights": shipped,
        "machines": [_machine_row(name, several, harsh) for name in machines],
        "folds": FOLDS,
    }
    return render(__file__, values)


def _sure(several: Sequence[Answer], confidence: Float) -> list[tuple[str | int, ...]]:
    """Count the verdicts of `SURE` and more, those that are right, and their bearings."""
    rows: list[tuple[str | int, ...]] = []
    for kind in KINDS:
        own = np.array([each.kind == kind for each in several])
        sure = [several[index] for index in np.flatnonzero(own & (confidence >= SURE)).tolist()]
        right = sum(each.is_right for each in sure)
        rows.append((KIND_WORDS[kind], len(sure), right, len({each.bearing for each in sure})))
    return rows


def _machine_row(name: str, several: Sequence[Answer], confidence: Float) -> tuple[str | int, ...]:
    weight = weights_of(several)
    here = [index for index, each in enumerate(several) if each.machine == name]
    row: list[str | int] = [name]
    for kind in KINDS:
        own = [index for index in here if several[index].kind == kind and np.isfinite(confidence[index])]
        if not own:
            row += [0, "", ""]
            continue
        row += [
            len(own),
            f"{np.average([several[index].is_right for index in own], weights=weight[own]):.2f}",
            f"{np.average(confidence[own], weights=weight[own]):.2f}",
        ]
    return tuple(row)


def main(arguments: Sequence[str] | None = None) -> int:
    """Analyse all records, go on where an earlier run was stopped, fit, judge, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("cwru", "mfpt", "hit"):
        parser.add_argument(f"--{name}", type=Path, metavar="FOLDER", help="with its .mat files")
    parser.add_argument(
        "--results", type=Path, metavar="FILE", help="JSON to keep answers in, and go on from"
    )
    args = parser.parse_args(arguments)
    chosen = records(args.cwru, args.mfpt, args.hit)
    if not chosen:
        parser.error("there is no known record below the folders")
    keep, found = KeptResults(args.results), []
    for record in chosen:
        key = f"{record.group} {record.name}"
        print(key, file=sys.stderr)
        found += keep.get(key, partial(answers, record))
    several = kept(found)
    found_weights = fitted(several)
    for kind, weights in found_weights.items():
        print(kind, weights)
    if found_weights != WEIGHTS:
        print("these are not the shipped ones: beardyn_core/monitor/chain/confidence.py", file=sys.stderr)
    confidence = judged(several)
    draw(several, confidence)
    groups = Counter(record.group for record in chosen)
    counts = ", ".join(f"{count} of {group}" for group, count in groups.items())
    PAGE.write_text(text(several, confidence, counts), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
