"""Features that a set was made without, worked out from its signals."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import numpy as np

import beardyn_core
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.chain import MonitorResult, MonitorSettings, Stretch
from beardyn_core.observe.monitoring import Monitor, MonitorInput
from beardyn_core.population.features import NAMES, ONCE, features_from, heard_in_band
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.store import RUN, SIGNALS, zarr_library

_KEPT_EVERY = 50
_CORE = Path(beardyn_core.__file__).parent


def listening_digest() -> str:
    """Hash the code that makes features of signals: the monitor, and what a learner takes of it."""
    digest = hashlib.sha256()
    for path in (*sorted((_CORE / "observe").rglob("*.py")), _CORE / "population" / "features.py"):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def up_to_date(runs: LabelledSet) -> LabelledSet:
    """Give a set the features that it was made without; they are kept beside its folder, as far as it got."""
    if set(NAMES) <= set(runs.features):
        return runs
    import pandas

    path = runs.folder.parent / f"{runs.folder.name}-features-{listening_digest()}.parquet"
    rows = pandas.read_parquet(path).to_dict("records") if path.is_file() else []
    group = zarr_library().open_group(str(runs.folder / SIGNALS), mode="r")
    times = tuple(np.rint(1e9 * group[name][:]).astype(np.int64) for name in ("time_vibration", "time_shaft"))
    whole = set(runs.runs_of().tolist())
    labels, before = runs.table.to_dict("records"), runs.features.to_dict("records")
    for index in range(len(rows), len(labels)):
        run = int(labels[index][RUN])
        known = dict.fromkeys(NAMES, float("nan"))
        if run in whole:
            known |= features_of_stored(runs, run, labels[index], before[index], times)
        rows.append({RUN: run, **known})
        if len(rows) % _KEPT_EVERY == 0 or len(rows) == len(labels):
            pandas.DataFrame(rows).to_parquet(path)
            print(f"features of {len(rows)} of {len(labels)} runs", flush=True)
    runs.features = pandas.DataFrame(rows[: len(labels)])
    return runs


def first_of(runs: LabelledSet, count: int | None) -> LabelledSet:
    """Leave the first runs of a set, all by default: those of a sweep that was asked for fewer."""
    if count is not None:
        runs.table, runs.features = runs.table.iloc[:count], runs.features.iloc[:count]
    return runs


def features_of_stored(
    runs: LabelledSet, run: int, label: dict[str, Any], before: dict[str, Any], times: tuple[Any, ...]
) -> dict[str, float]:
    """Work out what the features of before have not; where they have nothing but levels, all of them."""
    heard, turned = times  # [ns]
    values = np.asarray(runs.arrays["vibration"][run], np.float64)
    nothing = np.empty(0)
    part = MonitorInput(
        heard, values, turned, np.asarray(runs.arrays["shaft_angle"][run]),
        nothing.astype(np.int64), nothing, nothing.astype(np.int64), nothing,
    )  # fmt: skip
    names = {
        name: label[f"fault_frequencies_per_rev_{name.upper()}"] for name in ("ftf", "bpfo", "bpfi", "bsf")
    }
    orders, count = FaultFrequencies(**names), int(label["geometry_roller_count"])
    if not np.isfinite(before["score_cup"]):
        rate = (len(heard) - 1) * 1e9 / float(heard[-1] - heard[0])
        return features_from([part], values, rate, orders, count)
    found = {name: before[name] for name in NAMES if name in before}

    def in_band(
        stretch: Stretch, orders: FaultFrequencies, count: int, settings: MonitorSettings
    ) -> MonitorResult:
        found.update(heard_in_band(stretch, orders, count, settings))
        return MonitorResult("healthy", "", stretch.end_ns)

    monitor = Monitor(orders, count, settings=ONCE, algorithm=in_band)
    monitor.take(part)
    monitor.result()
    return found
