"""Which axlebox a file is of: from manifest and path, every mistake at once, nothing guessed."""

from __future__ import annotations

from pathlib import Path, PurePath

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.fleet.consistency import Known, find_contradictions
from beardyn_core.fleet.identity import Axlebox, FleetRecording, read_time
from beardyn_core.fleet.manifest import list_recordings
from beardyn_core.fleet.manifest_line import IDENTITY_COLUMNS, READING_COLUMNS, manifest_schema
from beardyn_core.fleet.path_pattern import PathPattern
from test.fleet.made_history import BEGIN, BOX, DAY, recording

PATTERN = "{vehicle}/{axle}_{side}/{date}.csv"


def files(folder: Path, *names: str) -> None:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name, encoding="utf-8")


def problems_of(folder: Path, **options: object) -> list[str]:
    with pytest.raises(InputError) as caught:
        list_recordings([folder], **options)  # type: ignore[arg-type]
    return list(caught.value.problems)


def test_a_path_states_vehicle_axle_side_and_date() -> None:
    found = PathPattern(PATTERN).read(PurePath("/data/V7/3_left/20260301_140500.csv"))
    assert found == {"vehicle": "V7", "axle": "3", "side": "left", "time": "20260301_140500"}
    assert PathPattern(PATTERN).read(PurePath("V7/notes.csv")) is None


@pytest.mark.parametrize("text", ["{wagon}/{date}.csv", "plain.csv", "{vehicle/{date}.csv"])
def test_a_pattern_that_names_nothing_or_something_unknown_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="pattern"):
        PathPattern(text)


def test_recordings_are_listed_from_paths_in_the_order_of_time(tmp_path: Path) -> None:
    files(tmp_path, "V1/1_left/2026-03-02.csv", "V1/1_left/2026-03-01.csv", "V1/2_R/2026-03-01.csv")
    found = list_recordings([tmp_path], pattern=PATTERN, defaults={"bearing": "HS130x230"}).recordings
    assert [each.axlebox for each in found] == [
        Axlebox("V1", "1", "left"),
        Axlebox("V1", "2", "right"),
        Axlebox("V1", "1", "left"),
    ]
    assert found[0].time == read_time("2026-03-01T00:00:00+00:00")
    assert {each.bearing for each in found} == {"HS130x230"}


def test_every_mistake_of_every_line_is_reported_with_file_and_key(tmp_path: Path) -> None:
    files(tmp_path, "a.csv", "b.csv", "c.csv")
    (tmp_path / "manifest.csv").write_text(
        "file,vehicle,axle,side,time,mileage_km,bearing_exchanged,colour\n"
        "a.csv,V1,,up,yesterday,-5,maybe,\n"
        "b.csv,V1,1,left,2026-03-01,far,,\n"
        "gone.csv,V1,1,left,2026-03-01,,,\n",
        encoding="utf-8",
    )
    told = "\n".join(problems_of(tmp_path))
    for part in (
        "colour is no column",
        "line 2: axle is missing",
        "line 2: side is 'up'",
        "line 2: time is 'yesterday'",
        "line 2: mileage_km is -5",
        "line 2: bearing_exchanged is 'maybe'",
        "line 3: mileage_km is 'far'",
        "line 4: file is gone.csv, which does not exist",
    ):
        assert part in told


def test_a_file_that_nothing_names_is_refused_or_told(tmp_path: Path) -> None:
    files(tmp_path, "a.csv", "b.csv")
    assert "nothing names its axlebox" in problems_of(tmp_path)[0]
    (tmp_path / "manifest.csv").write_text("file,vehicle,axle,side,time\na.csv,V,1,left,2026-03-01\n")
    listed = list_recordings([tmp_path])
    assert [each.path.name for each in listed.recordings] == ["a.csv"]
    assert "b.csv" in listed.warnings[0]


def test_options_name_one_file_and_what_they_lack_is_named(tmp_path: Path) -> None:
    files(tmp_path, "a.csv")
    own = {"vehicle": "W1", "axle": "1", "side": "left"}
    (told,) = problems_of(tmp_path / "a.csv", defaults=own)
    assert "time is missing" in told
    assert told.endswith("or as --time")
    (found,) = list_recordings([tmp_path / "a.csv"], defaults={**own, "time": "2026-03-01"}).recordings
    assert (found.axlebox, found.time) == (Axlebox("W1", "1", "left"), read_time("2026-03-01"))


def test_manifest_and_path_that_contradict_are_refused(tmp_path: Path) -> None:
    files(tmp_path, "V1/1_left/2026-03-01.csv")
    (tmp_path / "manifest.csv").write_text("file,axle,side\nV1/1_left/2026-03-01.csv,2,L\n")
    (told,) = problems_of(tmp_path, pattern=PATTERN)
    assert "axle is 2 in the manifest and 1 in the path" in told


def test_a_manifest_in_yaml_has_defaults_and_options_of_the_import(tmp_path: Path) -> None:
    files(tmp_path, "a.csv")
    (tmp_path / "manifest.yaml").write_text(
        "defaults: {vehicle: V1, bearing: HS130x230, speed_rpm: 900}\n"
        "recordings:\n- {file: a.csv, axle: 1, side: L, time: 2026-03-01, bearing_exchanged: true}\n"
    )
    (found,) = list_recordings([tmp_path]).recordings
    assert found.reading == {"speed_rpm": 900}
    assert found.exchanged
    assert found.axlebox == Axlebox("V1", "1", "left")


def test_the_schema_of_a_manifest_has_every_column_with_its_words() -> None:
    columns = manifest_schema()["properties"]["recordings"]["items"]["properties"]
    assert set(columns) == {*IDENTITY_COLUMNS, *READING_COLUMNS}
    assert all(each["description"] for each in columns.values())


def contradictions(*recordings: FleetRecording, known: tuple[Known, ...] = (), exchanged: float = 0.0) -> str:
    entries = [(BOX, exchanged)] if exchanged else []
    return "\n".join(find_contradictions(recordings, known, entries, BEGIN + 100 * DAY))


def test_recordings_without_contradiction_pass() -> None:
    assert contradictions(recording(0), recording(1), recording(1, BOX._replace(side="right"))) == ""


@pytest.mark.parametrize(
    ("second", "told"),
    [
        (recording(1, mileage=9e7), "mileage_km of V1 axle 1 left is 90,000"),
        (recording(1, bearing="NU205"), "set bearing_exchanged"),
        (recording(200), "in the future"),
        (recording(0, sha256="other"), "has two recordings of"),
        (recording(1, sha256=recording(0).sha256), "is the same recording as"),
    ],
)
def test_a_contradiction_is_told_with_file_and_key(second: FleetRecording, told: str) -> None:
    assert told in contradictions(recording(0), second)


def test_another_bearing_passes_where_its_exchange_is_entered() -> None:
    other = recording(1, bearing="NU205")
    assert contradictions(recording(0), recording(1, bearing="NU205", exchanged=True)) == ""
    assert contradictions(recording(0), other, exchanged=BEGIN + 0.5 * DAY) == ""
    assert contradictions(recording(0), other, exchanged=BEGIN + 1.5 * DAY) != ""


def test_a_recording_of_the_store_cannot_come_under_another_name() -> None:
    old = recording(0)
    known = Known(old.axlebox, old.time, old.mileage, old.bearing, old.key, "old.npz", False)
    assert contradictions(old, known=(known,)) == ""
    moved = recording(0, axlebox=BOX._replace(axle="2"))
    assert "is in the store as V1 axle 1 left" in contradictions(moved, known=(known,))
