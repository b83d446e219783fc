"""Write docs/evidence/beside_measured.md: measured bearings next to runs of the twin.

``python -m evidence.measured.texture --cwru FOLDER --mfpt FOLDER [--hit-sm FOLDER] [--records TABLE.csv]``.
`evidence.measured.own_records` says what the table of own recordings holds. With ``--results FILE`` what has
been measured is kept, so that a command that was cut off goes on.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError
from evidence.measured.cases import CWRU_SOUND, Record, listenings, records
from evidence.measured.own_records import measure_table
from evidence.measured.page import absent_of
from evidence.measured.texture_quantities import ENVELOPE_BAND, USABLE, WINDOW, Texture, measure
from evidence.measured.twin_runs import (
    DURATION,
    PARTS,
    SCENES,
    SETTLED,
    SPALLS,
    SURFACES,
    TIER,
    WIDTH_MM,
    TwinCase,
    fault_order,
    measure_twin,
    twin_cases,
)
from evidence.pages import REPORTS, write_page
from evidence.runner import KeptResults

PAGE = REPORTS / "beside_measured.md"
OWN = "own train"
FEW = 5  # records, of which least and most count
LONGEST = 20.0  # of a record that is measured, [s]
CONDITIONS = {"": "healthy", "cup": "outer ring (cup)", "cone": "inner ring (cone)", "roller": "roller"}
_SHOWN = (("", ""), *((part, spall) for part in PARTS for spall in SPALLS))
Getter = Callable[[Texture], float]


@dataclass(frozen=True)
class Measured:
    """A measured record, or a run of the twin."""

    group: A[str, "set of the record, or train of the twin"]
    part: A[str, "faulty part, '' when healthy"]
    texture: Texture
    case: A[TwinCase | None, "of a run of the twin"] = None


@dataclass(frozen=True)
class Quantity:
    """A quantity by which records and runs are compared."""

    name: str
    short: A[str, "name in the answer"]
    get: Getter
    form: A[str, "format of a number"] = ".2f"
    in_dB: A[bool, "whether differences are stated, not factors"] = False


@dataclass(frozen=True)
class Goal:
    """What runs of a train are to show."""

    name: str
    parts: tuple[str, ...]
    get: Getter
    low: float
    high: float
    form: str = ".2f"


def _low_share(octave: int) -> Getter:
    return lambda texture: 100.0 * float(texture.low_shares[octave])


QUANTITIES = (
    Quantity("share of 0.5-1 kHz in the power of 0.5-4 kHz, %", "0.5-1 kHz", _low_share(0), ".0f"),
    Quantity("share of 1-2 kHz in it, %", "1-2 kHz", _low_share(1), ".0f"),
    Quantity("share of 2-4 kHz in it, %", "2-4 kHz", _low_share(2), ".0f"),
    Quantity("4-12 kHz over 0.5-4 kHz, dB", "4-12 kHz", lambda each: each.high_over_low, ".1f", True),
    Quantity("kurtosis from 0.5 kHz", "kurtosis", lambda each: each.kurtosis, ".1f"),
    Quantity("modulation depth at the line", "modulation depth", lambda each: each.depth),
    Quantity("line over noise, dB", "line over noise", lambda each: each.line, ".1f", True),
    Quantity("ring-down, ms", "ring-down", lambda each: 1e3 * each.ring_down),
    Quantity("wander of the passage period, %", "wander", lambda each: 100.0 * each.wander),
)
GOALS = (
    Goal("modulation depth 0.1 to 0.4", ("cup",), lambda each: each.depth, 0.1, 0.4),
    Goal("kurtosis above 20", ("cone",), lambda each: each.kurtosis, 20.0, math.inf, ".1f"),
    Goal("ring-down 0.5 to 3 ms", ("", "cup", "cone"), lambda each: 1e3 * each.ring_down, 0.5, 3.0),
)


def measure_public(chosen: Sequence[Record], kept: KeptResults) -> Iterator[Measured]:
    """Measure public records: the faulty bearing of each, of a healthy machine every one."""
    for record in chosen:
        for listening in listenings(record):
            if record.part and not listening.part:
                continue  # it receives the fault of the other end
            signal = listening.acceleration[: round(LONGEST * listening.rate)]
            angle = 2.0 * np.pi * listening.shaft_frequency * np.arange(len(signal)) / listening.rate
            order = fault_order(listening.plate.frequencies, listening.part)
            found = kept.get(
                " | ".join((record.group, record.name, listening.end)),
                lambda signal=signal, rate=listening.rate, angle=angle, order=order: asdict(  # type: ignore[misc]
                    measure(signal, rate, angle, order)
                ),
            )
            group = "CWRU 48 kHz, healthy" if record.group == CWRU_SOUND else record.group
            yield Measured(group, listening.part, _texture(found))


def run_twin(kept: KeptResults, tell: Callable[[str], object]) -> Iterator[Measured]:
    """Run and measure every case of the twin."""
    for case in twin_cases():
        tell(case.key)
        found = kept.get(case.key, lambda case=case: asdict(measure_twin(case)))  # type: ignore[misc]
        yield Measured(case.train, case.part, _texture(found), case)


def _texture(found: dict[str, Any]) -> Texture:
    return Texture(**{**found, "levels": tuple(found["levels"])})


def compare(measured: Sequence[Measured], twin: Sequence[Measured]) -> Iterator[tuple[str, ...]]:
    """Compare the middle of the twin's runs with the range of the records, by condition, spall, quantity."""
    for part, spall in _SHOWN:
        runs = [each for each in twin if _spall(each) == spall]
        for quantity in QUANTITIES:
            of_records = _values(measured, part, quantity.get)
            of_twin = _values(runs, part, quantity.get)
            yield (
                _named(part, spall),
                quantity.name,
                str(len(of_records)),
                _three(of_records, quantity.form),
                _three(of_twin, quantity.form),
                verdict(of_records, of_twin, quantity.in_dB),
            )


def _named(part: str, spall: str) -> str:
    return f"{CONDITIONS[part]}, {spall}" if spall else CONDITIONS[part]


def verdict(of_records: Sequence[float], of_twin: Sequence[float], in_dB: bool) -> str:
    """Say where the middle of the twin's runs lies next to the middle 80 % of the records."""
    if not len(of_records) or not len(of_twin):
        return "not compared"
    middle = float(np.median(of_twin))
    least, _, most = middle_range(of_records)
    if least <= middle <= most:
        return "inside"
    edge, side = (most, "above") if middle > most else (least, "below")
    if in_dB:
        return f"{abs(middle - edge):.1f} dB {side}"
    smaller, larger = sorted((edge, middle))
    return f"{larger / smaller:.2f} times {side}" if smaller > 0.0 else side


def middle_range(values: Sequence[float]) -> tuple[float, float, float]:
    """Give the quantiles of 10, 50 and 90 %; of fewer than `FEW` values least, middle and most."""
    outer = (0.0, 1.0) if len(values) < FEW else (0.1, 0.9)
    low, middle, high = np.quantile(values, (outer[0], 0.5, outer[1]))
    return float(low), float(middle), float(high)


def list_alike(rows: Sequence[tuple[str, ...]]) -> list[tuple[str, str, str]]:
    """List by condition the quantities in which the twin lies inside the records, and those in which not."""
    short = {quantity.name: quantity.short for quantity in QUANTITIES}
    found = []
    for condition in dict.fromkeys(row[0] for row in rows):
        here = [row for row in rows if row[0] == condition and row[-1] != "not compared"]
        if not here:
            continue
        inside = [short[row[1]] for row in here if row[-1] == "inside"]
        outside = [f"{short[row[1]]} ({row[-1]})" for row in here if row[-1] != "inside"]
        found.append((condition, "; ".join(inside) or "none", "; ".join(outside) or "none"))
    return found


def list_groups(measured: Sequence[Measured]) -> Iterator[tuple[str, ...]]:
    """List the least, middle and most of the records of each set and part."""
    for group in dict.fromkeys(each.group for each in measured):
        for part, condition in CONDITIONS.items():
            here = [each for each in measured if each.group == group and each.part == part]
            if here:
                cells = [_three(_values(here, part, quantity.get), quantity.form) for quantity in QUANTITIES]
                yield (group, condition, str(len(here)), *cells[3:])


def list_octaves(measured: Sequence[Measured]) -> Iterator[tuple[str, ...]]:
    """List the middle level and share of each octave, by set, part and kind of spall."""
    keys = dict.fromkeys((each.group, each.part, _spall(each)) for each in measured)
    for group, part, spall in keys:
        here = [each for each in measured if (each.group, each.part, _spall(each)) == (group, part, spall)]
        levels = np.median([each.texture.levels for each in here], axis=0)
        shares = np.median([each.texture.shares for each in here], axis=0)
        cells = [
            f"{level:.2g} ({100.0 * share:.0f} %)" if math.isfinite(level) else "-"
            for level, share in zip(levels, shares, strict=True)
        ]
        above = [each.texture.above for each in here if math.isfinite(each.texture.above)]
        cells.append(f"{np.median(above):.2g}" if above else "-")
        yield (group, _named(part, spall), str(len(here)), *cells)


def _spall(each: Measured) -> str:
    return each.case.spall if each.case is not None else ""


def list_runs(twin: Sequence[Measured]) -> Iterator[tuple[str, ...]]:
    """List every run of the twin."""
    for each in twin:
        case, texture = each.case, each.texture
        assert case is not None
        yield (
            case.train,
            _named(case.part, case.spall),
            case.surface,
            _number(texture.high_over_low, ".1f"),
            _number(texture.above, ".2f"),
            _number(texture.kurtosis, ".1f"),
            _number(texture.whole_kurtosis, ".1f"),
            _number(texture.depth, ".2f"),
            _number(texture.line, ".1f"),
            _number(1e-3 * texture.ring_frequency, ".1f"),
            _number(1e3 * texture.ring_down, ".2f"),
            _number(100.0 * texture.wander, ".2f"),
        )


def list_goals(twin: Sequence[Measured]) -> Iterator[tuple[str, ...]]:
    """List the twin's values next to each goal, a column for each surface."""
    for goal in GOALS:
        for train in SCENES:
            for part in goal.parts:
                for spall in SPALLS if part else ("",):
                    here = {
                        each.case.surface: goal.get(each.texture)
                        for each in twin
                        if each.case is not None
                        and (each.case.train, each.case.part, each.case.spall) == (train, part, spall)
                    }
                    values = [value for value in here.values() if math.isfinite(value)]
                    inside = sum(goal.low <= value <= goal.high for value in values)
                    cells = [_number(here[surface], goal.form) for surface in SURFACES]
                    yield (goal.name, train, _named(part, spall), *cells, f"{inside} of {len(values)}")


def sum_goals(twin: Sequence[Measured]) -> list[str]:
    """Say of each goal how many runs lie inside, and from where to where the runs reach."""
    sentences = []
    for goal in GOALS:
        each_run = [goal.get(each.texture) for each in twin if each.part in goal.parts]
        values = [value for value in each_run if math.isfinite(value)]
        inside = sum(goal.low <= value <= goal.high for value in values)
        parts = ", ".join(CONDITIONS[part] for part in goal.parts)
        sentences.append(
            f"{goal.name}, {parts}: {inside} of {len(values)} runs inside, they reach from "
            f"{min(values):{goal.form}} to {max(values):{goal.form}}"
        )
    return sentences


def compare_levels(own: Sequence[Measured], twin: Sequence[Measured]) -> Iterator[tuple[str, ...]]:
    """List the levels of the twin less those of own records by octave, middles, [dB]."""
    for part, spall in _SHOWN:
        here = [each.texture.levels for each in own if each.part == part]
        for train in SCENES if here else ():
            runs = [
                each.texture.levels
                for each in twin
                if (each.group, each.part, _spall(each)) == (train, part, spall)
            ]
            difference = 20.0 * np.log10(np.median(runs, axis=0) / np.median(here, axis=0))
            yield (
                _named(part, spall),
                train,
                str(len(here)),
                *(_number(each, "+.1f") for each in difference),
            )


def count_inside(rows: Sequence[tuple[str, ...]], word: str) -> str:
    """Count the comparisons inside, of the conditions that have a word in their name."""
    verdicts = [row[-1] for row in rows if word in row[0] and row[-1] != "not compared"]
    return f"{verdicts.count('inside')} of {len(verdicts)}"


def _values(measured: Sequence[Measured], part: str, get: Getter) -> list[float]:
    values = [get(each.texture) for each in measured if each.part == part]
    return [value for value in values if math.isfinite(value)]


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else "-"


def _three(values: Sequence[float], form: str) -> str:
    """Write the middle range."""
    return ", ".join(format(value, form) for value in middle_range(values)) if len(values) else "-"


def page_values(
    public: Sequence[Measured], own: Sequence[Measured], twin: Sequence[Measured], absent: str
) -> dict[str, Any]:
    """Work out the numbers of the page."""
    reference = own or public
    rows = list(compare(reference, twin))
    counts = {part: sum(each.part == part for each in public) for part in CONDITIONS}
    return {
        "alike": list_alike(rows),
        "inside": {word: count_inside(rows, word) for word in ("healthy", "laboratory", "field")},
        "goals": sum_goals(twin),
        "goal_rows": list(list_goals(twin)),
        "comparison": rows,
        "groups": list(list_groups([*public, *own])),
        "octaves": list(list_octaves([*public, *own, *twin])),
        "runs": list(list_runs(twin)),
        "own": list(compare_levels(own, twin)),
        "reference": "own train's records" if own else "public records",
        "counts": ", ".join(f"{counts[part]} {name}" for part, name in CONDITIONS.items()),
        "healthy_count": counts[""],
        "absent": absent,
        "tier": TIER,
        "measured_s": DURATION - SETTLED,
        "width": WIDTH_MM,
        "length": SPALLS["laboratory"]["length_mm"],
        "depth": SPALLS["laboratory"]["depth_um"],
        "window": WINDOW,
        "band": "{:g} to {:g}".format(*(1e-3 * edge for edge in ENVELOPE_BAND)),
        "usable": USABLE,
        "few": FEW,
        "run_count": len(twin),
        "parts": len(PARTS),
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure records and runs, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cwru", type=Path, metavar="FOLDER", help="with the .mat files of CWRU")
    parser.add_argument("--mfpt", type=Path, metavar="FOLDER", help="with the .mat files of MFPT")
    parser.add_argument("--hit-sm", type=Path, metavar="FOLDER", help="with the .mat files of HIT-SM")
    parser.add_argument("--records", type=Path, metavar="TABLE.csv", help="recordings of your own train")
    parser.add_argument("--results", type=Path, metavar="FILE", help="JSON to keep quantities in")
    parser.add_argument(
        "-o", "--output", type=Path, default=PAGE, help="default docs/evidence/beside_measured.md"
    )
    args = parser.parse_args(arguments)
    found = records(args.cwru, args.mfpt, args.hit_sm)
    if not found and args.records is None:
        parser.error("there is no known record below the folders; give --cwru, --mfpt, --hit-sm or --records")
    try:
        own = [
            Measured(OWN, record.part, texture)
            for record, texture in (measure_table(args.records) if args.records is not None else ())
        ]
    except InputError as error:
        parser.exit(2, f"{error}\n")
    kept = KeptResults(args.results)
    public = list(measure_public(found, kept))
    twin = list(run_twin(kept, lambda sentence: print(sentence, file=sys.stderr)))
    write_page(__file__, args.output, page_values(public, own, twin, absent_of(found)))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
