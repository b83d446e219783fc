"""Surfaces of raceways and rollers as an axis of a trial."""

from __future__ import annotations

from dataclasses import replace

from beardyn_core.choice import load_trial, trial_scene
from beardyn_core.study.trial_report import json_object, slices
from beardyn_core.study.trial_result import TrialResult
from test.study.test_trial import run_of


def test_surfaces_are_runs_of_their_own_and_without_them_keys_stay_as_they_were() -> None:
    """The key of a run names its results in the store, and makes its seed."""
    quick = load_trial("quick")
    assert quick.cells()[0].key == "none 0 mm, 200 km/h, german_low, round, run 0, quasistatic"
    assert trial_scene(quick, quick.cells()[0]).scatter.made_surface == "typical"  # type: ignore[union-attr]
    trial = replace(quick, surfaces=("fine", "typical", "coarse"))
    cells = trial.cells()
    assert len({cell.key for cell in cells if not cell.checks}) == 3 * sum(
        not cell.checks for cell in quick.cells()
    )
    made = {cell.surface: trial_scene(trial, cell).scatter for cell in cells[:3]}
    assert {surface: scatter.surface for surface, scatter in made.items() if scatter} == {
        each: each for each in trial.surfaces
    }
    assert {"fine surface", "coarse surface"} <= {name for name, _ in slices(TrialResult.of(trial, "", []))}


def test_sizes_are_counted_on_each_surface() -> None:
    quick = load_trial("quick")
    trial = replace(quick, surfaces=("fine", "coarse"), check=None)
    runs = [run_of(cell, cell.fault if cell.surface == "fine" else "healthy") for cell in trial.cells()]
    result = TrialResult.of(trial, "", runs)
    for row in result.sizes():
        on = dict(row.on_surfaces)
        assert on["fine"].count == on["fine"].total == row.found.count > 0 == on["coarse"].count
    told = json_object(result)["sizes"][0]["surfaces"]
    assert [each["surface"] for each in told] == ["fine", "coarse"]
