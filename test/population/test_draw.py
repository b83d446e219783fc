"""Draws: the same from the seed alone, within their limits, and bearings that share nothing between parts."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import spearmanr

from beardyn_core.base.errors import InputError
from beardyn_core.config import json_schema, read_sweep, shipped_names
from beardyn_core.population.draw import rows_of
from beardyn_core.population.key_paths import AbsentError, place_of, with_value
from beardyn_core.population.table import splits_of, unit_in
from beardyn_core.scene.sweep import BEARING, Normal, Split, Sweep, Uniform, per_of
from test.population.sweeps import tiny


def sweep_of(**changes: Any) -> Sweep:
    return read_sweep(tiny(**changes))[0]


@pytest.mark.parametrize("sampling", ["sobol", "random"])
def test_more_runs_begin_with_those_of_fewer(sampling: str) -> None:
    few, many = (rows_of(sweep_of(sampling=sampling, runs=runs)) for runs in (5, 50))
    assert many[:5] == few


@pytest.mark.parametrize("sampling", ["sobol", "random", "latin_hypercube"])
def test_another_seed_draws_other_runs_and_the_same_seed_the_same(sampling: str) -> None:
    one, again, other = (rows_of(sweep_of(sampling=sampling, seed=seed)) for seed in (1, 1, 2))
    assert one == again
    assert all(a.drawn != b.drawn for a, b in zip(one, other, strict=True))
    assert not {row.seed for row in one} & {row.seed for row in other}


def test_sobol_and_latin_hypercube_fill_a_dimension_more_evenly_than_chance() -> None:
    def gap(sampling: str) -> float:
        key = "operation.speed_profile[0].speed_kmh"
        speeds = sorted(row.drawn[key] for row in rows_of(sweep_of(sampling=sampling, runs=64)))
        assert speeds[0] >= 80.0
        assert speeds[-1] <= 200.0
        return float(np.diff(speeds).max())

    even = 120.0 / 64.0
    assert gap("sobol") < 2.1 * even
    assert gap("latin_hypercube") < 2.1 * even
    assert gap("random") > 3.0 * even


@pytest.mark.parametrize("name", shipped_names("sweeps"))
@pytest.mark.parametrize("sampling", ["as shipped", "sobol"])
def test_nothing_that_a_run_has_tells_what_its_bearing_has(name: str, sampling: str) -> None:
    """Else a learner receives the speed and says the spall: two sequences of Sobol went together by 0.96."""
    sweep = read_sweep(name)[0]
    changes: dict[str, Any] = {} if sampling == "as shipped" else {"sampling": sampling}
    sweep = replace(sweep, runs=512 * sweep.runs_per_bearing, **changes)
    rows = rows_of(sweep)[:: sweep.runs_per_bearing]
    of_bearing = {each.key for each in sweep.drawn if per_of(each) == BEARING}
    keys = [key for key, value in rows[0].drawn.items() if isinstance(value, float)]
    values = np.array([[row.drawn[key] for key in keys] for row in rows])
    together = spearmanr(values).statistic * np.sqrt(len(rows))
    for k, one in enumerate(keys):
        for other, strength in zip(keys[:k], together[k], strict=False):
            if sampling == "as shipped" or (one in of_bearing) != (other in of_bearing):
                assert abs(strength) < 5.0, (one, other)


@pytest.mark.parametrize("name", shipped_names("sweeps"))
def test_no_learner_names_the_fault_without_a_signal(name: str) -> None:
    """Speed, load and temperature of a run say nothing of the spall; they named 77 % of `spalls` once."""
    ensemble = pytest.importorskip("sklearn.ensemble")
    from sklearn.metrics import balanced_accuracy_score
    from sklearn.model_selection import GroupKFold, cross_val_predict

    sweep = replace(read_sweep(name)[0], runs=800)
    of_bearing = {each.key for each in sweep.drawn if per_of(each) == BEARING}
    rows = rows_of(sweep)
    keys = [k for k, v in rows[0].drawn.items() if isinstance(v, float) and k not in of_bearing]
    values = np.array([[row.drawn[key] for key in keys] for row in rows])
    faults = np.array([str(row.drawn["defects"]) for row in rows])
    trees = ensemble.ExtraTreesClassifier(50, random_state=0)
    named = cross_val_predict(
        trees, values, faults, groups=np.array([row.bearing for row in rows]), cv=GroupKFold(4)
    )
    assert balanced_accuracy_score(faults, named) < 1.0 / len(set(faults)) + 0.1


def test_a_grid_has_every_combination_once() -> None:
    vary = [
        {"key": "end_play_mm", "kind": "uniform", "low": 0.0, "high": 0.2, "levels": 3},
        {"key": "temperature_C", "kind": "choice", "one_of": [20, 60]},
        {"key": "seed", "kind": "integer", "low": 5, "high": 6},
    ]
    rows = rows_of(sweep_of(sampling="grid", runs=None, vary=vary))
    found = {tuple(row.drawn.values()) for row in rows}
    assert len(rows) == len(found) == 12
    assert {each[0] for each in found} == {0.0, 0.1, 0.2}


def test_runs_of_a_bearing_share_what_it_is_made_of_and_differ_in_the_rest() -> None:
    rows = rows_of(sweep_of(runs=12, runs_per_bearing=4))
    assert [row.bearing for row in rows] == [0] * 4 + [1] * 4 + [2] * 4
    for bearing in range(3):
        own = [row for row in rows if row.bearing == bearing]
        assert len({row.drawn["defects[0].width_mm"] for row in own}) == 1
        assert len({row.lot for row in own}) == 1
        assert len({row.drawn["operation.speed_profile[0].speed_kmh"] for row in own}) == 4
        assert len({row.seed for row in own}) == 4
    assert len({row.lot for row in rows}) == 3


def test_normal_numbers_stay_within_their_ends_and_keep_their_mean() -> None:
    variable = Normal("x", 60.0, 10.0, low=40.0, high=80.0)
    shares = (np.arange(4000) + 0.5) / 4000
    numbers = np.array([variable.at(share) for share in shares])
    assert numbers.min() >= 40.0
    assert numbers.max() <= 80.0
    assert numbers.mean() == pytest.approx(60.0, abs=1e-3)
    assert numbers.std() == pytest.approx(8.796, abs=0.01)  # of a normal law cut at two deviations


def test_weights_decide_how_often_a_value_is_taken() -> None:
    vary = [
        {"key": "tier", "kind": "choice", "one_of": ["lumped", "full", "quasistatic"], "weights": [1, 0, 3]}
    ]
    drawn = [row.drawn["tier"] for row in rows_of(sweep_of(vary=vary, runs=64, sampling="sobol"))]
    assert drawn.count("full") == 0
    assert drawn.count("quasistatic") == 48


def test_no_bearing_is_in_two_parts_and_later_ones_change_nothing() -> None:
    bearings = [f"b{k // 3}" for k in range(300)]
    parts = splits_of(bearings, Split(), 1)
    assert all(
        len({part for b, part in zip(bearings, parts, strict=True) if b == name}) == 1 for name in bearings
    )
    assert splits_of(bearings[:60], Split(), 1) == parts[:60]
    shares = [parts.count(part) / 300 for part in ("train", "validation", "test")]
    assert shares == pytest.approx([0.7, 0.15, 0.15], abs=0.02)
    assert set(splits_of(bearings, Split(0.5, 0.0, 0.5), 1)) == {"train", "test"}


def test_a_value_is_set_where_its_path_says_and_nowhere_else(tmp_path: Path) -> None:
    scene = {"bearing": "HS130x230", "defects": [{"width_mm": 3}], "effects": "standard"}
    changed = with_value(scene, place_of("defects[0].width_mm"), 5, tmp_path)
    assert changed["defects"] == [{"width_mm": 5}]
    assert scene["defects"] == [{"width_mm": 3}]
    assert with_value(scene, place_of("effects.gravity"), True, tmp_path)["effects"] == {
        "preset": "standard",
        "gravity": True,
    }
    opened = with_value(scene, place_of("bearing.end_play_mm"), 0.3, tmp_path)["bearing"]
    assert opened["roller_count"]["value"] == 17
    assert opened["end_play_mm"] == 0.3
    graded = with_value(scene, place_of("scatter.grade"), "G2", tmp_path)
    assert graded["scatter"] == {"grade": "G2"}
    with pytest.raises(AbsentError):
        with_value(scene, place_of("defects[1].width_mm"), 5, tmp_path)
    with pytest.raises(InputError, match="has no keys"):
        with_value({"tier": 3}, place_of("tier.x"), 5, tmp_path)
    for wrong in ("", "a..b", "a[x]", "[0]", "a b"):
        with pytest.raises(InputError, match="no key path"):
            place_of(wrong)


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("load_fz_N_mean", "N"),
        ("defects[0].width_mm", "mm"),
        ("condition", ""),
        ("fault_frequencies_per_rev_BPFO", "per_rev"),
        ("sensors[0].noise_density_m_per_s2_per_sqrt_Hz", "m_per_s2_per_sqrt_Hz"),
        ("temperature_K", "K"),
        ("speed_kmh_max", "kmh"),
        ("roller_count", ""),
    ],
)
def test_the_unit_of_a_column_is_that_of_its_name(name: str, unit: str) -> None:
    assert unit_in(name) == unit


def test_every_mistake_of_the_file_is_told_at_once() -> None:
    wrong = {
        **tiny(runs=0, sampling="sobl", split={"train": 0.9}, seed=-1),
        "vary": [
            {"key": "a", "kind": "uniform", "low": 3, "high": 1},
            {"key": "a", "kind": "log_uniform", "low": -1, "high": 1},
            {"key": "b", "kind": "choice", "one_of": [1, 2], "weights": [1]},
            {"key": "c", "kind": "unifrom", "low": 1, "high": 2},
        ],
    }
    with pytest.raises(InputError) as refused:
        read_sweep(wrong)
    told = str(refused.value)
    for mistake in (
        "runs is 0; it must be at least 1",
        "did you mean 'sobol'?",
        "the shares add up to 1.2",
        "seed is -1",
        "high is 1; it must be at least low, 3",
        "vary[1].low is -1; it must be greater than 0",
        "weights has 1 entries; give one for each of 2",
        "did you mean 'uniform'?",
    ):
        assert mistake in told


def test_keys_given_twice_and_numbers_that_follow_nothing_are_refused() -> None:
    vary = [
        {"key": "seed", "kind": "scaled", "by": "temperature_C"},
        {"key": "seed", "kind": "integer", "low": 1, "high": 2},
    ]
    with pytest.raises(InputError) as refused:
        sweep_of(vary=vary)
    assert "vary[0].by is 'temperature_C'; it must be the key of an entry above" in str(refused.value)
    assert "vary[1].key is 'seed', given twice" in str(refused.value)


@pytest.mark.parametrize("name", shipped_names("sweeps"))
def test_shipped_sweeps_are_read_and_drawn(name: str) -> None:
    sweep, label = read_sweep(name)
    assert sweep.name == name
    assert label.endswith(f"{name}.yaml")
    assert len(rows_of(replace(sweep, runs=8))) == 8


def test_the_schema_knows_every_kind_of_draw() -> None:
    kinds = {name for name in json_schema("sweep")["$defs"] if name.endswith("Keys")}
    assert {"UniformKeys", "LogUniformKeys", "NormalKeys", "IntegerKeys", "ChoiceKeys", "ScaledKeys"} <= kinds


def test_numbers_are_of_six_digits() -> None:
    rows = rows_of(sweep_of(vary=[{"key": "end_play_mm", "kind": "uniform", "low": 0.0, "high": 0.3}]))
    assert all(float(f"{row.drawn['end_play_mm']:.6g}") == row.drawn["end_play_mm"] for row in rows)
    assert Uniform("x", 0.0, 1.0, levels=1).grid() == [0.5]
