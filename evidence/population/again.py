"""Features of a set worked out again from its signals, where the monitor has changed since it was made."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import numpy as np

import beardyn_core
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.monitoring import MonitorInput
from beardyn_core.population.features import NAMES, features_from
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.store import RUN, SIGNALS, zarr_library
from beardyn_core.study.code_digest import simulator_digest

_TOLD_EVERY = 100
_CORE = Path(beardyn_core.__file__).parent


def listening_digest() -> str:
    """Hash the code that makes features of signals: the monitor, and what a learner takes of it."""
    digest = hashlib.sha256()
    for path in (*sorted((_CORE / "observe").rglob("*.py")), _CORE / "population" / "features.py"):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def up_to_date(runs: LabelledSet) -> LabelledSet:
    """Give a set the features of the present code; they are kept beside its folder, which stays as it is."""
    if runs.about["code"] == simulator_digest():
        return runs
    import pandas

    path = runs.folder.parent / f"{runs.folder.name}-features-{listening_digest()}.parquet"
    if path.is_file():
        runs.features = pandas.read_parquet(path)
        return runs
    group = zarr_library().open_group(str(runs.folder / SIGNALS), mode="r")
    heard, turned = group["time_vibration"][:], group["time_shaft"][:]
    whole = set(runs.runs_of().tolist())
    rows = []
    for label in runs.table.to_dict("records"):
        run = int(label[RUN])
        known = dict.fromkeys(NAMES, float("nan"))
        if run in whole:
            known = _features(runs, run, label, heard, turned)
        rows.append({RUN: run, **known})
        if len(rows) % _TOLD_EVERY == 0:
            print(f"features of {len(rows)} of {len(runs)} runs", flush=True)
    runs.features = pandas.DataFrame(rows)
    runs.features.to_parquet(path)
    return runs


def _features(
    runs: LabelledSet, run: int, label: dict[str, Any], heard: Any, turned: Any
) -> dict[str, float]:
    values = np.asarray(runs.arrays["vibration"][run], np.float64)
    nothing = np.empty(0)
    part = MonitorInput(
        heard, values, turned, np.asarray(runs.arrays["shaft_angle"][run]),
        nothing.astype(np.int64), nothing, nothing.astype(np.int64), nothing,
    )  # fmt: skip
    names = {
        name: label[f"fault_frequencies_per_rev_{name.upper()}"] for name in ("ftf", "bpfo", "bpfi", "bsf")
    }
    rate = (len(heard) - 1) * 1e9 / float(heard[-1] - heard[0])
    return features_from([part], values, rate, FaultFrequencies(**names), int(label["geometry_roller_count"]))
