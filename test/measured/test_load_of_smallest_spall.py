"""The smallest spall is searched at the load that is known, and says what speaks against it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.cli import main as command
from beardyn_core.study import smallest_spall
from test.measured.files import RATE, table

COUNT = 60_000


@pytest.fixture
def loads(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Mean loads of the scenes in which spalls would have been searched."""
    found: list[Any] = []

    def search(
        _stretch: object, _axes: object, _orders: object, _rollers: object, made: Any, *_: object
    ) -> Any:
        found.append(made.operation.force[2])
        return ()

    monkeypatch.setattr(smallest_spall, "smallest_spalls_in", search)
    return found


def test_the_twin_runs_at_the_known_load(tmp_path: Path, loads: list[Any]) -> None:
    noise = np.random.default_rng(3).normal(size=COUNT)
    path = table(tmp_path / "a.csv", {"time_s": np.arange(COUNT) / RATE, "az [g]": noise})
    run = bd.read_measured(path, speed_rpm=1200.0)
    options: dict[str, Any] = {"twin": "service_high_speed", "bearing": "HS130x230"}
    assert "known vertical load" not in bd.smallest_spalls(run, **options).twin
    words = bd.smallest_spalls(run, load_kn="62:3", **options).twin
    assert "known vertical load: 62 kN, 90 % interval 59.1 to 65.1 kN; stated" in words
    doubtful = bd.smallest_spalls(run, load_kn="7:0.3", **options).twin
    assert "check the unit" in doubtful
    assert loads[1:] == pytest.approx([62e3, 7e3])
    assert loads[0] not in loads[1:]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--load-kn", "62:3"], "--load-kn is that of --smallest-spall"),
        (["--smallest-spall", "--load-kn", "62000"], "newtons meant"),
    ],
)
def test_a_load_of_the_monitor_that_makes_no_sense_is_refused_before_anything_is_analysed(
    options: list[str], sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    noise = np.random.default_rng(3).normal(size=6000)
    path = table(tmp_path / "a.csv", {"time_s": np.arange(6000) / RATE, "az [g]": noise})
    recording = tmp_path / "a.mcap"
    words = ["import", str(path), "--speed-rpm", "1200", "--bearing", "HS130x230", "-o", str(recording)]
    assert command.main(words) == 0
    assert command.main(["monitor", str(recording), *options]) == 2
    assert sentence in capsys.readouterr().err
