"""``fleet add`` on the workers of a Dask cluster: the same store as by this process alone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.experiments.cluster import LocalCluster
from beardyn_core.fleet.store import open_store
from test.fleet.made_history import write_files

SLOW = pytest.mark.slow  # two processes begin


@pytest.fixture(scope="module")
def workers() -> Iterator[LocalCluster]:
    started = LocalCluster(2, None)
    yield started
    started.close()


def stored(path: Path) -> list[tuple[Any, ...]]:
    with open_store(path) as store:
        found = [(e.axlebox, e.time, e.analysis.verdict, e.file) for e in store.recordings()]
    return sorted(found)


@SLOW
def test_workers_of_a_scheduler_give_the_same_store(
    workers: LocalCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = write_files(tmp_path / "own", 2)
    (tmp_path / "own" / lines[3]["file"]).write_bytes(b"PK\x03\x04 cut off")
    monkeypatch.chdir(tmp_path)  # paths are relative, and the workers are elsewhere
    told: list[tuple[int, int]] = []
    for name, address in (("one", ""), ("several", workers.address)):
        found = bd.fleet(f"{name}.sqlite").add(
            "own", estimator="none", progress=lambda *done: told.append(done), scheduler=address
        )
        assert (found.added, found.known, len(found.refused)) == (7, 0, 1)
        assert lines[3]["file"] in found.refused[0]
    assert stored(tmp_path / "one.sqlite") == stored(tmp_path / "several.sqlite")
    assert told == [(done, 8) for done in range(1, 9)] * 2
    again = bd.fleet("several.sqlite").add("own", estimator="none", scheduler=workers.address)
    assert (again.added, again.known) == (0, 7)


@SLOW
def test_a_worker_with_another_beardyn_is_refused(
    workers: LocalCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_files(tmp_path / "own", 1)
    monkeypatch.setattr("beardyn_core.fleet.intake.simulator_digest", lambda: "edited")
    with pytest.raises(InputError, match="a worker has another beardyn"):
        bd.fleet(tmp_path / "s.sqlite").add(tmp_path / "own", estimator="none", scheduler=workers.address)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"workers": 0}, "workers 0: allowed is 1 to"),
        ({"scheduler": "host"}, "scheduler host: it must be an address"),
        ({"scheduler": "tcp://host:1", "workers": 2}, "a scheduler has its own workers"),
    ],
)
def test_a_cluster_that_cannot_be_is_refused_before_anything(
    options: dict[str, Any], told: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=told):
        bd.fleet(tmp_path / "s.sqlite").add(tmp_path, **options)
    assert not (tmp_path / "s.sqlite").exists()
