"""Thousands of recordings: what is missing or twice in a store is found, and the pattern reads the files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from beardyn_core.fleet.path_pattern import PathPattern
from beardyn_core.fleet.store import open_store
from evidence.fleet.many import AXLEBOXES, KM_A_WEEK, PATTERN, boxes, counted, faults_of, path_of, width_mm
from evidence.fleet.signals import WIDTHS_MM
from test.fleet.made_history import analysis, recording


def test_the_pattern_reads_who_each_file_is() -> None:
    every = boxes()
    assert len(set(every)) == AXLEBOXES
    box = every[123]
    found = PathPattern(PATTERN).read(Path("some/folder") / path_of(box, 3))
    assert found == {**box._asdict(), "time": "20250127", "mileage_km": str(100_000 + 3 * KM_A_WEEK)}


def test_spalls_grow_from_the_least_width_to_the_largest() -> None:
    widths = [width_mm(week, 20) for week in range(20)]
    assert (widths[0], widths[-1]) == (WIDTHS_MM[0], WIDTHS_MM[-1])
    assert widths == sorted(widths)
    assert width_mm(0, 1) == WIDTHS_MM[0]


def test_what_is_missing_or_twice_is_found(tmp_path: Path) -> None:
    folder, path = tmp_path / "recordings", tmp_path / "s.sqlite"
    folder.mkdir()
    assert counted(path) == 0
    files = [folder / f"{day}.npz" for day in range(3)]
    for each in files:
        each.touch()
    with open_store(path, write=True, make=True) as store:
        for day in (0, 1):
            store.add(recording(day, path=files[day]), analysis())
    assert counted(path) == 2
    assert faults_of(path, folder) == [f"1 recordings are missing, such as {files[2]}"]
    with open_store(path, write=True) as store:
        store.add(recording(2, path=files[2]), analysis())
    assert faults_of(path, folder) == []
    with open_store(path, write=True) as store:
        store.add(replace(recording(3, path=files[2]), sha256="of a file that was written again"), analysis())
    (told,) = faults_of(path, folder)
    assert told == "1 recordings are in it twice"
