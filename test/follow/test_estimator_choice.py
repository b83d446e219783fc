"""Which estimator is found for a bearing and for the axes that are measured, and what is said without one."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import KINDS
from beardyn_core.config import load_any_bearing, load_bearing, load_plate
from beardyn_core.follow import estimator_choice
from beardyn_core.follow.descriptors import AXES, names_of
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.estimator_choice import estimator_for, how_to_train, list_own, own_folder
from beardyn_core.follow.inference import doubt_of
from beardyn_core.follow.live_choice import LiveChoice
from beardyn_core.follow.shipped import shipped_estimators
from test.bearings import CYLINDRICAL, SPHERICAL
from test.follow.synthetic import PLATE
from test.follow.test_intake import measured, signal

MINE = replace(load_bearing("HS130x230"), name="mine", roller_count=15)


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the user's own estimators, empty; nothing is shipped."""
    monkeypatch.setenv("BEARDYN_DATA_DIR", str(tmp_path / "data"))
    monkeypatch.setattr(estimator_choice, "list_shipped", list)
    own_folder().mkdir(parents=True)
    return own_folder()


def of_axes(axes: str = "xyz", plate: NamePlate = PLATE) -> Estimator:
    """An estimator that takes some axes; its numbers are those of a shipped one of three."""
    shipped = estimator_for(PLATE, known=shipped_estimators())
    count = len(names_of(tuple(axes)))
    return replace(shipped, axes=tuple(axes), plate=plate, middle=shipped.middle[:count])


def test_the_most_axes_that_are_measured_are_taken(own: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    several = [of_axes("z"), of_axes("xyz"), of_axes("xz"), of_axes("xyz", replace(PLATE, roller_count=9))]
    monkeypatch.setattr(estimator_choice, "readable_estimators", lambda: iter(several))
    assert estimator_for(PLATE) is several[1]
    assert estimator_for(PLATE, ("x", "z")) is several[2]
    assert estimator_for(PLATE, ("z",)) is several[0]
    with pytest.raises(
        InputError, match="estimators of the axes x, y, z and of x, z and of z; measured are y"
    ):
        estimator_for(PLATE, ("y",))


def test_an_own_estimator_is_found_and_the_newest_first(own: Path) -> None:
    for k, name in enumerate(("old", "new")):
        of_axes().save(own / f"{name}.npz")
        os.utime(own / f"{name}.npz", (k, k))
    (own / "other.npz").write_bytes(b"of another version")
    assert [path.stem for path in list_own()] == ["other", "new", "old"]
    assert estimator_for(PLATE).axes == ("x", "y", "z")


@pytest.mark.parametrize(
    ("own_axes", "measured_axes", "taken"),
    [
        ("z", "z", "own z"),
        ("z", "xyz", "shipped xyz"),
        ("xyz", "xyz", "own xyz"),
        ("xyz", "z", "shipped z"),
        ("xz", "xz", "own xz"),
        ("xz", "z", "shipped z"),
    ],
)
def test_the_own_comes_before_the_shipped_where_its_axes_are_measured(
    own_axes: str,
    measured_axes: str,
    taken: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("BEARDYN_DATA_DIR", str(tmp_path))
    own_folder().mkdir(parents=True)
    mine = of_axes(own_axes)
    replace(mine, card={**mine.card, "mine": True}).save(own_folder() / "mine.npz")
    found = estimator_for(PLATE, tuple(measured_axes))
    assert f"{'own' if 'mine' in found.card else 'shipped'} {''.join(found.axes)}" == taken


def test_a_live_choice_follows_the_axes_that_come(own: Path) -> None:
    with pytest.raises(InputError, match="has no estimator yet"):
        LiveChoice(PLATE)
    for axes in ("z", "xyz"):
        of_axes(axes).save(own / f"{axes}.npz")
    choice, block = LiveChoice(PLATE), np.ones((4, 3))
    assert choice.estimator.axes == AXES
    assert choice.take(block * [np.nan, np.nan, 1.0]).axes == ("z",)
    assert choice.take(block).axes == AXES
    assert choice.take(block * [np.nan, 1.0, 1.0]).axes == AXES  # a gap in an axis that has come
    alone = LiveChoice(PLATE)
    for _ in range(2):  # and not once alone
        with pytest.raises(InputError, match="measured are x: `beardyn train --bearing HS130x230 --axes x`"):
            alone.take(block * [1.0, np.nan, np.nan])
    assert alone.take(block).axes == AXES


def test_a_recording_is_estimated_with_the_own_estimator(own: Path, tmp_path: Path) -> None:
    path = measured(tmp_path, signal(2.0))
    with pytest.raises(
        InputError, match="HS130x230 has no estimator yet: `beardyn train --bearing HS130x230`"
    ):
        bd.estimate(path)
    of_axes().save(own / "mine.npz")
    assert bd.estimate(path).stretches == 1
    assert bd.follow(path).steps


def test_the_command_that_makes_one_has_the_axis_that_is_measured(own: Path, tmp_path: Path) -> None:
    of_axes().save(own / "mine.npz")
    path = measured(tmp_path, signal(2.0, axes=1))
    for ask in (bd.estimate, bd.follow):
        with pytest.raises(InputError, match="measured are z: `beardyn train --bearing HS130x230` makes one"):
            ask(path)
    told = how_to_train(PLATE, ("x", "y"))
    assert told.startswith("`beardyn train --bearing HS130x230 --axes xy` makes one, in 30 to 90 min")


def test_the_command_names_what_has_the_whole_bearing() -> None:
    assert how_to_train(MINE, recording="run.mcap").startswith("`beardyn train --bearing run.mcap` makes one")
    assert how_to_train(MINE).startswith("`beardyn train --bearing FILE.yaml` makes one")
    data = replace(PLATE, name="6205", roller_count=9)
    assert how_to_train(data).startswith(
        "estimators are for tapered, cylindrical and spherical roller bearings"
    )
    imitation = replace(data, name="HS130x230")
    assert "--bearing FILE.yaml" in how_to_train(imitation)


@pytest.mark.parametrize("name", [*CYLINDRICAL, *SPHERICAL])
def test_pairs_and_spherical_bearings_have_the_command_too(own: Path, name: str) -> None:
    for bearing in (load_any_bearing(name), load_plate(name)):
        with pytest.raises(
            InputError, match=f"{name} has no estimator yet: `beardyn train --bearing {name}`"
        ):
            estimator_for(bearing)
    mine = replace(load_any_bearing(name), name="mine")
    assert "`beardyn train --bearing run.mcap`" in how_to_train(mine, recording="run.mcap")


@pytest.mark.parametrize("learnt", KINDS)
@pytest.mark.parametrize("asked", KINDS)
def test_an_estimator_is_not_for_a_bearing_of_another_kind_with_the_same_rollers(
    own: Path, learnt: str, asked: str
) -> None:
    """Also where the contact angle is zero, and after a way through a file."""
    plates = {kind: replace(PLATE, kind=kind, contact_angle=0.0) for kind in KINDS}
    of_axes(plate=plates[learnt]).save(own / "mine.npz")
    if learnt == asked:
        assert estimator_for(plates[asked]).plate.kind == learnt
        return
    with pytest.raises(InputError, match="has no estimator yet"):
        estimator_for(plates[asked])
    assert f"17 {learnt} rollers of 26.7 mm" in doubt_of(read_estimator(own / "mine.npz"), plates[asked])


def test_bearing_data_alone_are_taken_by_their_sizes(own: Path) -> None:
    of_axes().save(own / "mine.npz")
    assert PLATE.kind == "tapered"
    assert estimator_for(replace(PLATE, kind="")).plate.kind == "tapered"


def test_files_of_earlier_versions_are_of_tapered_bearings(own: Path) -> None:
    of_axes().save(own / "mine.npz")
    with np.load(own / "mine.npz") as file:
        stored = {name: file[name] for name in file.files}
    head = json.loads(str(stored.pop("head")))
    assert head["plate"].pop("kind") == "tapered"
    np.savez(own / "old.npz", head=np.array(json.dumps(head)), **stored)
    assert read_estimator(own / "old.npz").plate.kind == "tapered"
