"""The card of an estimator, and what the command prints of it."""

from __future__ import annotations

import json
from dataclasses import astuple, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.cli import train as command
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.main import main
from beardyn_core.config import load_any_bearing, load_plate
from beardyn_core.follow import judging, labelled, training
from beardyn_core.follow.wide_spall import WideRule
from test.cli.json_page import check
from test.follow.synthetic import NAMES, PLATE, RATE, STRETCH, drawn, taught

ABOUT = {"sweep": "made", "code": "digest", "licence": "CC-BY-4.0"}
PARTS = {"train": 80, "validation": 40, "test": 60, None: 50}


def bearings_made(seed: int, one: bool = False) -> pd.DataFrame:
    """The columns that tell the bearings of a set and their rides apart."""
    seeds = seed + np.arange(4)
    lots = np.full(4, 7) if one else seeds
    names = [f"b{each}" for each in lots]
    return pd.DataFrame({"bearing_id": names, "status": "complete", "seed": seeds, "scatter_seed": lots})


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Any:
    """A set whose runs are drawn when they are asked for."""
    seeds = {part: seed for seed, part in enumerate(PARTS, start=20)}
    monkeypatch.setattr(training, "describe_runs", lambda _runs, part, _axes: drawn(PARTS[part], seeds[part]))
    for module in (training, labelled):
        monkeypatch.setattr(module, "plate_of", lambda each: each.plate)
    time = np.arange(round(STRETCH * RATE) + 1) / RATE
    signals = SimpleNamespace(time_vibration=time)
    return SimpleNamespace(folder="made", about=ABOUT, plate=PLATE, signals=signals, table=bearings_made(0))


def test_card_says_what_was_learnt_from_and_what_judged_it(runs: Any) -> None:
    found = training.train(runs)
    check(
        "train",
        json.loads(json_text("train", {"file": Path("one.npz"), "card": found.card, "other_files": []})),
    )
    assert (found.rate, found.stretch) == pytest.approx((RATE, STRETCH))
    assert found.card["runs"] == PARTS["train"]
    assert found.card["condition"]["runs"] == PARTS["test"]
    load = found.card["quantities"]["vertical_load"]
    text = command.table(found).text()
    assert f"{100 * load['test']['error']:.0f} %" in text
    named = f"named in {100 * found.card['condition']['named']:.0f} %"
    assert any(line.startswith("condition") and named in line for line in text.splitlines())
    depth = next(line for line in text.splitlines() if "depth" in line)
    assert depth.split()[-1] == "-"  # it is not identifiable, and nothing is promised of it


def test_other_sets_calibrate_and_judge(runs: Any) -> None:
    about = {"about": {**ABOUT, "sweep": "truer"}}
    other, judge = (
        SimpleNamespace(**{**vars(runs), **about, "table": bearings_made(seed)}) for seed in (100, 200)
    )
    found = training.train(runs, calibration=[other], test=judge)  # type: ignore[list-item, arg-type]
    assert found.card["runs"] == PARTS["train"]  # the other parts calibrate, too
    assert found.card["calibration"] == ["truer", "made, validation and test"]
    assert found.card["test"] == "truer"
    assert found.card["condition"]["runs"] == PARTS[None]


@pytest.mark.slow
def test_sets_that_calibrate_judge_themselves_crosswise(runs: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    judged_by: list[tuple[tuple[float, ...], int]] = []

    def noted(estimator: Any, asked: Any) -> Any:
        judged_by.append((tuple(estimator.part.least), len(asked.bearings)))
        return judging.PartJudged(*(np.ones((len(asked.bearings), *more), bool) for more in ((), (2,))))

    monkeypatch.setattr(judging, "part_judged", noted)
    other: Any = SimpleNamespace(**{**vars(runs), "table": bearings_made(100)})
    found = training.train(runs, calibration=[other])
    assert found.card["test"] == "calibration, crosswise"
    assert found.card["condition"]["runs"] == PARTS[None]
    assert sum(count for _, count in judged_by) == PARTS[None]
    assert len(judged_by) == judging.CROSSWISE
    assert len({least for least, _ in judged_by}) > 1  # each by the others


@pytest.mark.parametrize("enough", [True, False])
def test_a_width_that_too_few_runs_prove_has_both_readings_and_no_number(
    enough: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    learnt = taught(drawn(200, 1))
    rule = WideRule(np.zeros((3, len(NAMES))), np.zeros(3), np.array([39e-3, 29e-3]), 34e-3)
    reach = np.array([1.0, 2.0 if enough else np.inf])
    few = replace(learnt, wide=rule, regressions={"width": replace(learnt.regressions["width"], reach=reach)})
    calibrated: list[Any] = []

    def noted(estimator: Any, *_: Any) -> Any:
        calibrated.append(estimator.wide)
        return few

    monkeypatch.setattr(training, "_calibrate", noted)
    used, found = training._calibrate_width(replace(learnt, wide=rule), drawn(50, 2), None)
    assert found is few
    assert [each.gives_numbers for each in calibrated] == ([True] if enough else [True, False])
    assert used.wide is not None
    assert used.wide.gives_numbers is enough


@pytest.mark.parametrize("one", [False, True])
@pytest.mark.parametrize("role", ["calibration", "test", "both"])
def test_sets_of_bearings_that_were_learnt_from_are_refused(role: str, one: bool, runs: Any) -> None:
    """The same sweep in another tier draws the same bearings; one bearing alone rides anew."""
    runs.table = bearings_made(0, one)
    others = [
        SimpleNamespace(**{**vars(runs), "folder": "others", "table": bearings_made(seed, one)})
        for seed in ((100, 102) if role == "both" else (2, 2))
    ]
    of = "others" if role == "both" else "made"
    with pytest.raises(
        InputError, match=f"others: 2 of its {'rides' if one else 'bearings'} are those of {of}"
    ):
        training.train(
            runs,
            calibration=others[:1] if role != "test" else [],  # type: ignore[arg-type]
            test=others[1] if role != "calibration" else None,  # type: ignore[arg-type]
        )


def table_of(*names: str) -> pd.DataFrame:
    """The columns that tell drawing and kind of the bearings of a set; of older ones the kind is empty."""
    bearings = [load_any_bearing(name) for name in names]
    keys = ("roller_count", "roller_diameter", "pitch_diameter", "contact_angle")
    units = {"roller_diameter": "_m", "pitch_diameter": "_m", "contact_angle": "_rad"}
    numbers = {
        f"geometry_{key}{units.get(key, '')}": [getattr(each, key) for each in bearings] for key in keys
    }
    return pd.DataFrame({"bearing": names, "bearing_kind": [each.kind for each in bearings], **numbers})


def test_bearings_of_several_drawings_are_refused_before_they_are_read() -> None:
    table = table_of("HS130x230", "SRB120x260")
    runs: Any = SimpleNamespace(folder="mixed", about=ABOUT, table=table)
    with pytest.raises(InputError, match="mixed: has the bearings HS130x230, SRB120x260"):
        training.train(runs)


@pytest.mark.parametrize("name", ["FR130x230x150", "WJ130x240", "SRB120x260"])
def test_data_of_a_set_are_those_of_its_bearing_and_its_kind(name: str) -> None:
    runs: Any = SimpleNamespace(folder="one", table=table_of(name, name))
    plate, known = labelled.plate_of(runs), load_plate(name)
    assert (plate.name, plate.kind) == (name, known.kind)
    for one, other in zip(astuple(plate.frequencies), astuple(known.frequencies), strict=True):
        assert one == pytest.approx(other, rel=1e-12)


def test_an_older_set_is_of_tapered_bearings() -> None:
    for table in (
        table_of("HS130x230").drop(columns="bearing_kind"),
        table_of("HS130x230").assign(bearing_kind=""),
    ):
        runs: Any = SimpleNamespace(folder="old", table=table)
        assert labelled.plate_of(runs).kind == "tapered"


def test_a_set_of_the_same_rollers_in_a_bearing_of_another_kind_is_refused(runs: Any) -> None:
    other: Any = SimpleNamespace(**{**vars(runs), "plate": replace(PLATE, kind="cylindrical")})
    with pytest.raises(InputError, match="its bearing is"):
        labelled.check_alike(runs, other)


@pytest.mark.parametrize("key", ["scatter_seed", "bearing_id"])
def test_a_lot_is_known_by_the_seed_of_its_scatter_and_without_by_its_drawing(key: str) -> None:
    table = bearings_made(0)
    if key == "bearing_id":  # bearings of several drawings, none with scatter
        table = table.assign(scatter_seed=None)
    runs: Any = SimpleNamespace(folder="made", table=table)
    other: Any = SimpleNamespace(folder="others", table=table.assign(bearing_id="of another grade", seed=9))
    if key == "scatter_seed":
        with pytest.raises(InputError, match="others: 4 of its bearings are those of made"):
            labelled.check_unseen([runs], other)
    else:
        labelled.check_unseen([runs], other)
        other.table = table.assign(seed=9)
        with pytest.raises(InputError, match="others: 4 of its bearings are those of made"):
            labelled.check_unseen([runs], other)
    assert not labelled.is_one_bearing(runs)


def test_runs_of_one_bearing_are_parted_by_their_rides() -> None:
    assert list(judging.crosswise_parts(np.array(["b", "b"]))) == []
    one, several = (SimpleNamespace(table=bearings_made(0, each)) for each in (True, False))
    assert labelled.is_one_bearing(one)  # type: ignore[arg-type]
    assert not labelled.is_one_bearing(several)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("unlike", "sentence"),
    [
        ({"plate": load_plate("METRO120x220")}, "its bearing is METRO120x220, that of made is HS130x230"),
        ({"seconds": 2.0}, "its length of a run is 2 s, that of made is 1.5 s"),
        ({"rate": 12_800.0}, "its sampling rate is 12800 Hz, that of made is 25600 Hz"),
    ],
)
@pytest.mark.parametrize("role", ["calibration", "test"])
def test_sets_of_another_bearing_or_sampling_are_refused(
    unlike: dict[str, Any], sentence: str, role: str, runs: Any
) -> None:
    how: dict[str, Any] = {"rate": RATE, "seconds": STRETCH, "plate": PLATE} | unlike
    time = np.arange(round(how["seconds"] * how["rate"]) + 1) / how["rate"]
    signals = SimpleNamespace(time_vibration=time)
    other: Any = SimpleNamespace(folder="others", about=ABOUT, plate=how["plate"], signals=signals)
    how = {"calibration": [other] if role == "calibration" else [], "test": other if role == "test" else None}
    with pytest.raises(InputError, match=f"others: {sentence}"):
        training.train(runs, calibration=how["calibration"], test=how["test"])


def test_too_few_runs_are_refused(runs: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(PARTS, "train", 30)
    with pytest.raises(InputError, match="has 30 complete runs to learn from; 40 are needed"):
        training.train(runs)


def test_options_that_cannot_be_are_refused_at_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["train", str(tmp_path), "-o", str(tmp_path / "one.txt"), "--axes", "zw"]) == 2
    told = capsys.readouterr().err
    assert "let its name end in .npz" in told
    assert "--axes: 'zw' is no set of axes; give one or more of x, y and z, each once" in told
    one = tmp_path / "one.npz"
    one.touch()
    assert main(["train", str(tmp_path), "-o", str(one), "--test", str(one), "--force"]) == 2
    assert "an input is never replaced" in capsys.readouterr().err


@pytest.mark.parametrize("straightened", [False, True])
def test_a_calibration_without_a_spalled_run_leaves_spalls_untold(straightened: bool) -> None:
    sound = drawn(60, 3)
    for name in ("width", "length", "depth"):
        sound.truth[name][:] = np.nan
    found = taught(sound, straightened)
    assert not {"width", "length", "depth"} & set(found.regressions)
    assert "lateral_load" in found.regressions or "vertical_load" in found.regressions


def test_a_calibration_of_one_bearing_is_not_learnt_from_alone() -> None:
    one = drawn(60, 3)
    one.bearings[:] = one.bearings[0]
    assert taught(one, straightened=True).regressions


@pytest.mark.slow
def test_a_number_whose_interval_does_not_hold_is_not_reported(
    runs: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of 60 runs an interval of 90 % may miss 10 by chance; half of them are too many."""
    right = training.train(runs)
    monkeypatch.setattr(judging, "score_of", lambda *_: judging.Score(60, 0.9, 0.1, 0.0, (0.3, 0.5)))
    found = training.train(runs)
    described = drawn(5, 50).descriptors
    assert right.estimates(described)["vertical_load"].reason == ""
    assert found.estimates(described)["vertical_load"].reason == "not reported: no runs prove its interval"
    assert "test" not in found.card["quantities"]["vertical_load"]


def test_chance_may_leave_some_runs_outside() -> None:
    shares = {48: False, 49: True, 60: True}
    scores = {count: judging.Score(60, 0.9, 0.1, 0.0, (0.5, count / 60)) for count in shares}
    assert {count: judging.is_held(each) for count, each in scores.items()} == shares
