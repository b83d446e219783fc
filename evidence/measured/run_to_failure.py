"""When the trend alarms in the runs to failure of PRONOSTIA, and how steadily what it receives then grows.

``python -m evidence.measured.run_to_failure --pronostia DIR`` writes docs/evidence/run_to_failure.md. DIR has
``Learning_set`` and ``Full_Test_Set`` with a folder of ``acc_*.csv`` for each run.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from scipy.stats import spearmanr

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.trend import ALARM, Trend, TrendSettings, record_levels
from evidence.pages import REPORTS, render
from evidence.runner import Arrays, kept_arrays

PAGE = REPORTS / "run_to_failure.md"
SETS = ("Learning_set", "Full_Test_Set")
RATE, EVERY_S, G = 25_600.0, 10.0, 9.80665
RMS_RISE = 6.0  # [dB]
_FEWEST = 10  # records to judge growth by
_STEADY = 0.7  # rank correlation from which growth is called steady, a round number
_SYNTHETIC = (20, 2000, 1.0)  # runs, records of each, deviation of a level [dB]


@dataclass(frozen=True)
class Levels:
    """Levels of the records of one run."""

    bands: A[Float, "shape [record, axis, band], [dB]"]
    rms: A[Float, "shape [record, axis], [dB]"]


@dataclass(frozen=True)
class Judged:
    """When something alarmed in a run, in records."""

    first: A[int | None, "the first alarm"]
    stays: A[int | None, "from which on it stays to the end"]
    share: A[float, "of the run in alarm"]

    @classmethod
    def of(cls, alarms: Sequence[bool]) -> Judged:
        """Judge alarms of the records, shape [record]."""
        alarmed = np.array(alarms, bool)
        off = np.flatnonzero(~alarmed)
        stays = (int(off[-1]) + 1 if len(off) else 0) if alarmed[-1] else None
        return cls(int(alarmed.argmax()) if alarmed.any() else None, stays, float(alarmed.mean()))


@dataclass(frozen=True)
class Grown:
    """How steadily a number grew towards the end of a run; 1 is without a step back."""

    quarter: A[float, "Spearman's rank correlation with time, last quarter"]
    tenth: A[float, "the same of the last tenth"]
    alarmed: A[float, "the same from where the alarm stays, NaN in fewer than 10 records"]
    fall: A[float, "largest step back from an earlier peak in the last tenth, [dB]"]
    end: A[float, "at the end, [dB]"]


def read_record(path: Path) -> Float:
    """Read a record: horizontal and vertical acceleration, shape [sample, axis], [m/s^2]."""
    text = path.read_bytes().replace(b";", b",").replace(b"\r", b"")
    rows = [line.split(b",")[4:6] for line in text.splitlines() if line]
    return np.array(rows).astype(float) * G


def levels_of_run(folder: Path, kept: Path | None) -> Levels:
    """Compute the levels of all records of a run, or take them from where an earlier go has kept them."""

    def measured() -> Arrays:
        bands, rms = [], []
        for file in sorted(folder.glob("acc_*.csv")):
            record = read_record(file)
            bands.append(record_levels(record, RATE))
            rms.append(10.0 * np.log10(np.maximum(record.var(axis=0), 1e-12)))
        return {"bands": np.array(bands), "rms": np.array(rms)}

    return Levels(**kept_arrays(None if kept is None else kept / f"{folder.name}.npz", measured))


def by_trend(levels: Levels) -> Judged:
    """Let the trend watch a run."""
    trend = Trend(("x", "y"))
    states = [trend.take(each, EVERY_S * k).state for k, each in enumerate(levels.bands)]
    return Judged.of([state == ALARM for state in states])


def by_rms(levels: Levels) -> Judged:
    """Alarm where the rms of an axis is over that of the first records, record by record."""
    start = np.median(levels.rms[: TrendSettings().baseline], axis=0)
    return Judged.of([bool((rms - start > RMS_RISE).any()) for rms in levels.rms])


def added_energy(levels: Levels) -> Float:
    """Give what the bands have over their first records, median of the last few, shape [record], [dB].

    It stands for the size of the damage, whose widths nobody measured: powers of all bands and axes that are
    above those of the baseline, in sum, over the power of the baseline; 0 dB is nothing added.
    """
    settings = TrendSettings()
    power = 10.0 ** (0.1 * levels.bands.reshape(len(levels.bands), -1))
    power = power[:, np.isfinite(power).all(axis=0)]
    base = np.median(power[: settings.baseline], axis=0)
    added = 10.0 * np.log10(1.0 + np.maximum(power - base, 0.0).sum(axis=1) / base.sum())
    first = np.repeat(added[:1], settings.smooth - 1)
    windows = np.lib.stride_tricks.sliding_window_view(np.concatenate([first, added]), settings.smooth)
    return np.asarray(np.median(windows, axis=1))


def grown(levels: Levels, stays: int | None) -> Grown:
    """Judge how steadily the added energy grows."""
    added = added_energy(levels)
    tenth, quarter = (added[-max(round(share * len(added)), _FEWEST) :] for share in (0.1, 0.25))
    alarmed = added[stays:] if stays is not None else added[:0]
    return Grown(
        _rank_correlation(quarter),
        _rank_correlation(tenth),
        _rank_correlation(alarmed) if len(alarmed) >= _FEWEST else np.nan,
        float(np.max(np.maximum.accumulate(tenth) - tenth)),
        float(added[-1]),
    )


def _rank_correlation(values: Float) -> float:
    """Compute Spearman's rank correlation with time: 1 where values only grow."""
    return float(spearmanr(np.arange(len(values)), values).statistic)


def synthetic_alarms(seed: int = 1) -> int:
    """Count the alarms in steady levels that scatter, one record independent of the other."""
    random = np.random.default_rng(seed)
    runs, records, deviation = _SYNTHETIC
    found = 0
    for _ in range(runs):
        trend, earlier = Trend(("x", "y")), False
        for k in range(records):
            now = trend.take(random.normal(0.0, deviation, (2, 5)), EVERY_S * k).state == ALARM
            found += now and not earlier
            earlier = now
    return found


class Found(NamedTuple):
    """What there is to say of a run."""

    records: int
    trend: Judged
    rms: Judged
    grown: Grown


def page(found: dict[str, dict[str, Found]]) -> str:
    """Write the page of all runs, by set and name."""
    every = [each for runs in found.values() for each in runs.values()]
    settings = TrendSettings()
    runs, records, deviation = _SYNTHETIC
    alarmed = [each.grown.alarmed for each in every if np.isfinite(each.grown.alarmed)]
    values = {
        "settings": settings,
        "bands": len(settings.edges) - 1,
        "rms_rise": RMS_RISE,
        "sets": [
            (name.replace("_", " "), [_row(run, of_run) for run, of_run in each.items()])
            for name, each in found.items()
        ],
        "growth": [_growth_row(run, each.grown) for own in found.values() for run, each in own.items()],
        "steady": _STEADY,
        "quarter": sum(each.grown.quarter >= _STEADY for each in every),
        "tenth": sum(each.grown.tenth >= _STEADY for each in every),
        "steady_in_alarm": sum(each >= _STEADY for each in alarmed),
        "alarmed": len(alarmed),
        "fewest": _FEWEST,
        "count": len(every),
        "stay": sum(each.trend.stays is not None for each in every),
        "rms_stay": sum(each.rms.stays is not None for each in every),
        "broken": sum(each.trend.first != each.trend.stays for each in every),
        "synthetic_runs": runs,
        "synthetic_records": records,
        "deviation": deviation,
        "synthetic_alarms": synthetic_alarms(),
    }
    return render(__file__, values)


def _row(run: str, found: Found) -> tuple[str, ...]:
    """List the cells of a run."""
    count, trend, rms, _ = found
    left = "-" if trend.first is None else f"{(count - trend.first) * EVERY_S / 60.0:.0f}"
    return (
        run,
        f"{count}",
        _share(trend.first, count),
        left,
        _share(trend.stays, count),
        f"{100.0 * trend.share:.0f} %",
        _share(rms.first, count),
        _share(rms.stays, count),
    )


def _growth_row(run: str, now: Grown) -> tuple[str, ...]:
    """List how steadily the added energy of a run grows."""
    told = "-" if np.isnan(now.alarmed) else f"{now.alarmed:.2f}"
    return run, f"{now.quarter:.2f}", f"{now.tenth:.2f}", told, f"{now.fall:.1f}", f"{now.end:.1f}"


def _share(record: int | None, count: int) -> str:
    return "never" if record is None else f"{100.0 * record / count:.1f} %"


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pronostia", metavar="DIR", type=Path, required=True)
    parser.add_argument(
        "--keep", metavar="DIR", type=Path, help="keep the levels here, and take them from here"
    )
    args = parser.parse_args()
    found: dict[str, dict[str, Found]] = {}
    for name in SETS:
        folders = sorted(each for each in (args.pronostia / name).glob("Bearing*") if each.is_dir())
        if not folders:
            sys.exit(f"{args.pronostia / name}: has no folder Bearing*; give the folder of the data set")
        found[name] = {}
        for folder in folders:
            levels = levels_of_run(folder, args.keep)
            trend = by_trend(levels)
            found[name][folder.name] = Found(
                len(levels.rms), trend, by_rms(levels), grown(levels, trend.stays)
            )
            print(folder.name, *found[name][folder.name][1:], flush=True)
    PAGE.write_text(page(found), encoding="utf-8")


if __name__ == "__main__":
    main()
