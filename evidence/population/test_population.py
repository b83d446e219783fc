"""The page of sweeps says what was measured; records and further sets are what they are said to be."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import savemat

from beardyn_core.config import read_sweep
from beardyn_core.effects import ModalStructure
from beardyn_core.experiments import Cluster, Engine
from beardyn_core.population.draw import rows_of
from beardyn_core.population.sweep_scenes import scenes_of
from evidence.population import page as page_module
from evidence.population.measured import collection_of, features_of_records, records
from evidence.population.page import section, write_page
from evidence.population.scale import waited
from evidence.population.sets import OTHERS, SPEED, other_sweep


def found() -> dict[str, Any]:
    matrix = {"cup": {"cup": 3, "cone": 1}, "cone": {"cone": 4}}
    gap = [
        {"features": kind, "name": name, "count": 8, "accuracy": 0.9, "balanced": share, "matrix": matrix,
         "width_error": error, "width_bias": 0.0}
        for kind in page_module.FEATURES
        for name, share, error in (("unseen bearings", 0.875, 0.21), ("measured: CWRU", 0.5, float("nan")))
    ]  # fmt: skip
    made = {
        "runs": 2000,
        "failed": 3,
        "worker_s": 2400.0,
        "processes": 2,
        "cores": 2,
        "bytes_a_run": 4e5,
    }
    engine = [{"workers": 2, "runs": 24, "wall_s": 6.5, "efficiency": 0.92, "bytes": 1.5e8}]
    cores = [
        {
            "workers": 1,
            "runs": 24,
            "wall_s": 10.0,
            "processor_s": 0.34,
            "besides_s": 0.02,
            "busy": 0.95,
            "bytes": 4e8,
        },
        {
            "workers": 2,
            "runs": 48,
            "wall_s": 12.5,
            "load": 3.2,
            "processor_s": 0.35,
            "besides_s": 0.02,
            "busy": 0.9,
            "bytes": 4e8,
        },
    ]
    causes = {
        "lines": {"whitened": 0.66, "both": 0.78},
        "sizes": {"1400": 0.78, "700": 0.7},
        "widths": [
            {"low": 1.0, "high": 2.0, "runs": 44, "right": 0.31},
            {"low": 0.0, "high": 0.0, "runs": 92, "right": 0.9},
        ],
    }
    formats = [{"format": "Zarr", "bytes_a_run": 4e5, "share": 0.6, "read_s": 0.1}]
    return {
        "gap": gap, "trained": 1400, "tier": "lumped", "effects": "auto", "made": made, "engine": engine,
        "cores": cores, "formats": formats, "causes": causes,
    }  # fmt: skip


def test_the_page_says_what_was_measured() -> None:
    text = section(found())
    assert "(tier `lumped`, effects `auto`)" in text
    assert "| unseen bearings | 8 | 88 % (90 %) | 88 % (90 %) | 21 % |" in text
    assert "| measured: CWRU | 8 | 50 % (90 %) | 50 % (90 %) | - |" in text
    assert "| cup | 1 | 3 |" in text
    assert "| all features | 88 % | **38 points** |" in text
    assert "whitened: 66 %, both: 78 %. With fewer runs to learn from: 78 % of 1400 runs, 70 % of 700" in text
    assert "| 1 to 2 mm | 44 | 31 % |" in text
    assert "| healthy | 92 | 90 % |" in text
    assert "A sweep of 2000 runs of 2 s, 3 failed" in text
    assert "busy with them for 20 min each" in text
    # 3600 s x 90 % / (0.35 + 0.02) s
    assert "| 2 | 48 | 0.350 s | 0.020 s | 90 % | 8757 | 400 MB | 12 s | 3 |" in text
    # 3600 x 0.9 / 0.37 over 3600 x 0.95 / 0.36, and twice the runs in 12.5 s in place of 10
    assert "92 % of the runs an hour of each core" in text
    assert "by the clock 80 %" in text
    # 1e4 runs of 0.36 s at 90 % are 1.1 h, 1e6 are 111 h and 400 GB
    assert "| 10 000 | 1.1 h |" in text
    assert "| 1 000 000 | 111 h | 14 h | 5.6 h | 400 GB | 20 MB/s |" in text  # the scheduler's 0.02 s a run
    assert "| 2 | 24 | 6.50 s | 92 % | 150 MB |" in text


def test_writing_again_keeps_what_is_above_the_mark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page_module, "PAGE", tmp_path / "learner.md")
    monkeypatch.setattr(page_module, "PICTURE", tmp_path / "population.png")
    (tmp_path / "learner.md").write_text("# By hand\n")
    for _ in range(2):
        write_page(json.loads(json.dumps(found())))
    text = (tmp_path / "learner.md").read_text()
    assert text.startswith("# By hand\n")
    assert text.count(page_module.MARK) == text.count("## How fast, how big") == 1
    assert (tmp_path / "population.png").stat().st_size > 1000


@pytest.mark.slow
@pytest.mark.parametrize("name", OTHERS)
def test_further_sets_differ_by_what_their_name_says_and_share_no_bearing(name: str) -> None:
    trained, _ = read_sweep("spalls")
    plan = scenes_of(*read_sweep(other_sweep(name, 8)))
    rows = rows_of(plan.sweep)
    assert not {row.lot for row in rows} & {row.lot for row in rows_of(trained)}
    scene = plan.scene(rows[0])
    changed = {
        "other speeds": rows[0].drawn[SPEED] >= 180.0,
        "another tier": scene.tier == "quasistatic",
        "a box that rings": isinstance(scene.effects.structure, ModalStructure),
    }
    assert [each for each, so in changed.items() if so] == [name]


def test_records_are_named_by_their_folders_and_have_the_features_of_simulated_runs(tmp_path: Path) -> None:
    """Impacts at the pass frequency of the outer ring, in files as those collections have them."""
    place = tmp_path / "12k_Drive_End_Bearing_Fault_Data" / "OR" / "007"
    place.mkdir(parents=True)
    rate, turns, random = 12_000, 29.5, np.random.default_rng(1)
    time = np.arange(4 * rate) / rate
    since = np.mod(time, 1.0 / (3.5848 * turns))
    signal = np.exp(-since * 800.0) * np.sin(2 * np.pi * 3400.0 * since)
    signal += 0.05 * random.normal(size=len(time))
    savemat(place / "130.mat", {"X130_DE_time": signal[:, None], "X130RPM": 60.0 * turns})
    (tmp_path / "other.txt").write_text("x")
    (only,) = records(tmp_path)
    assert (only.condition, collection_of(only)) == ("cup", "CWRU")
    features, conditions = features_of_records([only])
    assert conditions.tolist() == ["cup"]
    scores = {name: values[0] for name, values in features.items() if name.startswith("score_")}
    assert max(scores, key=lambda name: scores[name]) == "score_cup"
    assert scores["score_cup"] > 20.0


@pytest.mark.slow
def test_eight_workers_take_an_eighth_of_the_time_of_slow_runs() -> None:
    """At least 80 % on a machine with other work; docs/evidence/learner.md has what was measured."""
    import time

    with Engine(Cluster(workers=8)) as engine:
        list(engine.run(waited, range(16), 0.01))
        began = time.perf_counter()
        assert sum(1 for _ in engine.run(waited, range(96), 0.5)) == 96
        assert 0.8 * (time.perf_counter() - began) < 6.0
