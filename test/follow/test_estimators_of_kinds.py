"""An estimator of cylinders and of barrels from runs to estimates, and bearings that it is not for.

The same is claimed fast, with made data, in `test_estimator_choice` and `test_training`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.follow import learning, training
from beardyn_core.follow.estimator import read_estimator
from beardyn_core.follow.labelled import describe_runs

pytestmark = pytest.mark.slow

FEWEST, RUNS, SECONDS = 8, 24, 1.3
KEYS: dict[str, Any] = {"tier": "lumped", "effects": {"preset": "standard"}, "background": None}
SPALL = {"kind": "spall", "on": "cup", "row": 0, "width_mm": 8, "depth_um": 100, "length_mm": 20}
SCENES = {"WJ130x240": "freight_cylindrical_cup", "SRB120x260": "freight_spherical_cup"}


@pytest.fixture(scope="module", params=SCENES)
def learnt(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """Learn from few and short runs of the simplest tier; how well it does is not asked for."""
    folder = tmp_path_factory.mktemp(request.param)
    sweep = {
        "sweep": "few",
        "purpose": "few runs",
        "scene": SCENES[request.param],
        "set": {**KEYS, "duration_s": SECONDS},
        "runs": RUNS,
        "split": {"train": 0.5, "validation": 0.25, "test": 0.25},
        "vary": [
            {"key": "defects", "kind": "choice", "one_of": [[], [SPALL]]},
            {"key": "radial_clearance_mm", "kind": "uniform", "low": 0.05, "high": 0.2},
            {"key": "operation.payload_t", "kind": "uniform", "low": 0, "high": 70},
            {"key": "operation.lateral_force_kN", "kind": "uniform", "low": -5, "high": 5},
        ],
    }
    with pytest.MonkeyPatch.context() as patch:
        for module in (training, learning):
            patch.setattr(module, "FEWEST", FEWEST)
        runs = bd.sweep(sweep, folder / "runs", workers=1)
        bd.train(runs, folder / "one.npz", axes=["z"])
    return request.param, folder


def test_their_quantities_are_loads_and_no_end_play(learnt: tuple[str, Path]) -> None:
    """An end play is that of tapered units; here the radial clearance differs from run to run."""
    name, folder = learnt
    runs = bd.open_set(folder / "runs")
    described = describe_runs(runs, None, ("z",))
    # some descriptors need more passages than a short run has
    assert np.isfinite(described.descriptors).mean() > 0.95
    assert len(set(runs.table["radial_clearance_m"])) == RUNS
    found = read_estimator(folder / "one.npz")
    assert (found.plate.name, found.plate.kind) == (name, bd.bearing(name).kind)
    assert {"vertical_load", "lateral_load"} <= set(found.card["quantities"])
    assert "end_play" not in found.card["quantities"]


def test_it_reads_a_recording_of_its_bearing_and_no_tapered_one(
    learnt: tuple[str, Path], tmp_path: Path
) -> None:
    name, folder = learnt
    estimator, own, other = folder / "one.npz", tmp_path / "own.mcap", tmp_path / "other.mcap"
    for scene, path in ((SCENES[name], own), ("service_freight", other)):
        bd.simulate(bd.scene(scene, **KEYS, duration=SECONDS + 0.2), record=path)
    found = bd.estimate(own, estimator)
    assert found.stretches == 1
    assert found.part is not None
    assert len(bd.follow(own, estimator).steps) == 1
    bearing = bd.bearing(name)
    rollers = f"the estimator is for {name}, {bearing.roller_count} {bearing.kind} rollers of"
    for ask in (bd.estimate, bd.follow):
        with pytest.raises(InputError, match=f"{rollers}.*; the run is of FR130x230x150, 20 tapered rollers"):
            ask(other, estimator)
