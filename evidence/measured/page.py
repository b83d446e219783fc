"""Write docs/evidence/monitor_measured.md: ``python -m evidence.measured.page --cwru DIR --mfpt DIR``."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path

from beardyn_core.monitor.chain import MonitorSettings
from evidence.measured.cases import CWRU_12_DRIVE, SETS, Record, listenings, records
from evidence.measured.grades import MEANINGS
from evidence.measured.run import METHODS, Measurement, outcomes, verdicts_of
from evidence.pages import REPORTS, render
from evidence.runner import KeptResults

PAGE = REPORTS / "monitor_measured.md"
PARTS = ("cup", "cone", "roller")
# the same harness over the same files with the chain before whitening, commit a5d4a3d: right, wrong, missed
BEFORE = {
    ("CWRU 12 kHz, drive end", "cup"): (24, 1, 3),
    ("CWRU 12 kHz, drive end", "cone"): (12, 0, 4),
    ("CWRU 12 kHz, drive end", "roller"): (2, 4, 10),
    ("CWRU 12 kHz, fan end", "cup"): (13, 5, 3),
    ("CWRU 12 kHz, fan end", "cone"): (12, 0, 0),
    ("CWRU 12 kHz, fan end", "roller"): (1, 0, 11),
    ("CWRU 48 kHz, drive end", "cup"): (6, 0, 1),
    ("CWRU 48 kHz, drive end", "cone"): (1, 0, 2),
    ("CWRU 48 kHz, drive end", "roller"): (0, 0, 3),
    ("MFPT", "cup"): (7, 0, 0),
    ("MFPT", "cone"): (7, 0, 0),
}
BEFORE_GRADES = {"Y1": (9, 0, 0), "Y2": (28, 2, 5), "P1": (1, 0, 0), "P2": (0, 1, 4), "N1": (0, 2, 8)}
BEFORE_BESIDE, BEFORE_SOUND = (188, 2042), (0, 20)  # analyses with an alarm, and all


def receive(
    chosen: Sequence[Record], results: Path | None, tell: Callable[[str], object] = lambda sentence: None
) -> list[Measurement]:
    """Let every method judge every bearing, but those in the results already; keep them as they come."""
    kept, received = KeptResults(results), []
    for record in chosen:
        tell(f"{record.group} {record.name}")
        for listening in listenings(record):
            for method, algorithm in METHODS.items():
                key = " | ".join((record.group, record.name, listening.end, method))
                verdicts = kept.get(key, partial(verdicts_of, listening, algorithm))
                received.append(Measurement(record, listening.end, listening.part, method, verdicts))
    return received


def text(received: Sequence[Measurement], absent: str) -> str:
    """Write the page."""
    faulty = [each for each in received if each.part]
    beside = [each for each in received if not each.part and each.record.part]
    sound = [each for each in received if not each.record.part]
    judged = [each for each in faulty if each.record.group != CWRU_12_DRIVE]
    before = [counts for (group, _), counts in BEFORE.items() if group != CWRU_12_DRIVE]
    values = {
        "count": len({each.record.path for each in received}),
        "absent": absent,
        "bound": MonitorSettings().least_strikes,
        "parts": list(_part_rows(faulty)),
        "all": _counts(faulty, _sum(list(BEFORE.values()))),
        "judged": _counts(judged, _sum(before)),
        "grades": list(_grade_rows(faulty)),
        "sound": [
            ("beside a faulty one", *_alarms(beside, BEFORE_BESIDE)),
            ("in a healthy machine", *_alarms(sound, BEFORE_SOUND)),
        ],
        "records": [
            _row(record, list(group_of))
            for record, group_of in groupby(received, key=lambda each: each.record)
        ],
    }
    return render(__file__, values)


def _part_rows(faulty: Sequence[Measurement]) -> Iterator[tuple[str, ...]]:
    for group in SETS:
        for part in PARTS:
            here = [each for each in faulty if (each.record.group, each.part) == (group, part)]
            if here:
                yield group, part, *_counts(here, BEFORE.get((group, part)))


def _grade_rows(faulty: Sequence[Measurement]) -> Iterator[tuple[str, ...]]:
    for grade, meaning in MEANINGS.items():
        here = [each for each in faulty if each.record.grade == grade]
        if here:
            number = len({each.record for each in here})
            yield grade, meaning, str(number), *_counts(here, BEFORE_GRADES.get(grade))


def _counts(received: Sequence[Measurement], before: tuple[int, ...] | None) -> list[str]:
    """List right/wrong/missed of each method, with what was before in the second place."""
    cells = []
    for method in METHODS:
        found = outcomes([each for each in received if each.method == method])
        cells.append(f"{found['right']}/{found['wrong']}/{found['missed']}")
    cells.insert(1, "/".join(map(str, before)) if before else "-")
    return cells


def _sum(counts: Sequence[tuple[int, ...]]) -> tuple[int, ...]:
    return tuple(sum(column) for column in zip(*counts, strict=True))


def _alarms(received: Sequence[Measurement], before: tuple[int, int]) -> list[str]:
    cells = []
    for method in METHODS:
        here = [each for each in received if each.method == method]
        cells.append(_share(sum(each.alarms for each in here), sum(each.analyses for each in here)))
    cells.insert(1, _share(*before))
    return cells


def _share(alarms: int, analyses: int) -> str:
    return f"{alarms} of {analyses}, {100.0 * alarms / analyses:.2g} %" if analyses else "none received"


def _row(record: Record, received: Sequence[Measurement]) -> list[str]:
    """List the cells of a record."""

    def said(part_known: bool, method: str) -> str:
        here = [each for each in received if bool(each.part) == part_known and each.method == method]
        return ", ".join(
            f"{each.verdict} {each.verdicts.get(each.verdict, 0)}/{each.analyses}" for each in here
        )

    faulty = bool(record.part)
    size = f" {record.diameter}" if record.diameter else ""
    place = f" at {record.clock}" if record.clock else ""
    name = record.name if record.group == "MFPT" else f"CWRU {record.name}"
    return [
        name,
        f"{record.part or 'healthy'}{size}{place}",
        str(record.load) if record.group != "MFPT" else "",
        record.grade,
        *(said(faulty, method) for method in METHODS),
        said(False, "ours") if faulty else "",
    ]


def absent_of(found: Sequence[Record]) -> str:
    """Say how many of the known files were not there."""
    from evidence.measured.cases import cwru_known

    have = {int(each.name) for each in found if each.group.startswith("CWRU")}
    missing = Counter(group for number, (group, *_) in cwru_known().items() if number not in have)
    told = [f"{missing[group]} of {group}" for group in SETS if missing[group]]
    if not any(each.group == "MFPT" and not each.part for each in found):
        told.append("the healthy baselines of MFPT")
    return ", ".join(told) if told else "nothing"


def main(arguments: Sequence[str] | None = None) -> int:
    """Hear the records and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cwru", type=Path, metavar="FOLDER", help="with the .mat files of CWRU")
    parser.add_argument("--mfpt", type=Path, metavar="FOLDER", help="with the .mat files of MFPT")
    parser.add_argument("--results", type=Path, metavar="FILE", help="JSON to keep counts in, and go on from")
    parser.add_argument(
        "-o", "--output", type=Path, default=PAGE, help="default docs/evidence/monitor_measured.md"
    )
    args = parser.parse_args(arguments)
    found = records(args.cwru, args.mfpt)
    if not found:
        parser.error("there is no known record below the folders")
    received = receive(found, args.results, lambda sentence: print(sentence, file=sys.stderr))
    args.output.write_text(text(received, absent_of(found)), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
