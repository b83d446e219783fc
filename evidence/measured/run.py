"""Monitors over the records: what each says of every bearing, and how often."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.monitor.chain import (
    REFERENCE,
    Algorithm,
    Chain,
    FaultLines,
    MonitorSettings,
    Stretch,
    Verdict,
)
from beardyn_core.monitor.chain.fault_lines import comb_score
from beardyn_core.monitor.chain.tracking import by_angle
from beardyn_core.monitor.chain.whitening import not_whitened
from beardyn_core.monitor.streaming import Monitor
from evidence.measured.cases import Listening, Record, listenings

SECONDS = 0.5  # of a block that a monitor gets at once
INTERVAL = 1.0  # between two analyses, [s]
NO_ANALYSIS = ("waiting",)


def surest_pattern(found: FaultLines, stretch: Stretch, settings: MonitorSettings) -> Verdict:
    """Report the fault with most evidence if it passes its threshold, whatever else there is."""
    best = max(found.candidates, key=lambda candidate: candidate.evidence)
    called = best.score >= best.threshold
    return Verdict(best.pattern.fault if called else "healthy", "", best)


METHODS: dict[str, Algorithm] = {
    "ours": REFERENCE,
    "envelope": Chain(whiten=not_whitened, track=by_angle, score=comb_score, decide=surest_pattern),
    "CPW": Chain(track=by_angle, score=comb_score, decide=surest_pattern),
}


@dataclass(frozen=True)
class Measurement:
    """What one monitor says of one bearing in one record."""

    record: Record
    end: A[str, "of the machine, '' when it has one bearing"]
    part: A[str, "that is faulty, '' when sound"]
    method: str
    verdicts: A[Mapping[str, int], "analyses with each verdict, the one that came last at the end"]

    @property
    def analyses(self) -> int:
        """Analyses with an answer."""
        return sum(count for verdict, count in self.verdicts.items() if verdict not in NO_ANALYSIS)

    @property
    def verdict(self) -> str:
        """The verdict of most of them, of as many the later one, as ``beardyn monitor`` sums up."""
        answers = {name: count for name, count in self.verdicts.items() if name not in NO_ANALYSIS}
        most = max(answers.values(), default=0)
        return [name for name, count in answers.items() if count == most][-1] if answers else "waiting"

    @property
    def alarms(self) -> int:
        """Analyses that call a part."""
        return sum(self.verdicts.get(part, 0) for part in ("cup", "cone", "roller"))

    @property
    def outcome(self) -> str:
        """``right``, ``wrong`` (another part is called) or ``missed``."""
        if self.verdict == self.part:
            return "right"
        return "wrong" if self.verdict in ("cup", "cone", "roller") else "missed"


def verdicts_of(
    received: Listening, algorithm: Algorithm, settings: MonitorSettings | None = None
) -> dict[str, int]:
    """Feed a record to a monitor block by block, as a train would, and count its verdicts."""
    settings = settings or MonitorSettings(interval=INTERVAL)
    monitor = Monitor(
        received.plate.frequencies, received.plate.roller_count, received.rate, settings, algorithm
    )
    count = len(received.acceleration)
    time_ns = np.round(np.arange(count) * (1e9 / received.rate)).astype(np.int64)
    angle = np.asarray(2.0 * np.pi * received.shaft_frequency * np.arange(count) / received.rate, np.float64)
    block = int(SECONDS * received.rate)
    found: dict[str, int] = {}
    for first in range(0, count, block):
        here = slice(first, first + block)
        monitor.push_vibration(time_ns[here], received.acceleration[here])
        monitor.push_shaft(time_ns[here], angle[here])
        result = monitor.update()
        if result is not None:
            found[result.verdict] = found.pop(result.verdict, 0) + 1
    return found


def run(
    records: Iterable[Record],
    methods: Mapping[str, Algorithm],
    tell: Callable[[str], object] = lambda sentence: None,
) -> Iterator[Measurement]:
    """Let every method receive every bearing of every record."""
    for record in records:
        tell(f"{record.group} {record.name}")
        for listening in listenings(record):
            for method, algorithm in methods.items():
                counts = verdicts_of(listening, algorithm)
                yield Measurement(record, listening.end, listening.part, method, counts)


def outcomes(received: Sequence[Measurement]) -> Counter[str]:
    """Count the outcomes of faulty bearings."""
    return Counter(each.outcome for each in received if each.part)
