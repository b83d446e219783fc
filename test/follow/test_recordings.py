"""One bearing followed over several recordings: what goes on, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.mounting import TURNED, Mounting
from beardyn_core.follow.residual import Residual, residual_of
from test.cli.json_page import check
from test.follow.synthetic import drawn, taught
from test.recordings import import_noise


def recording(folder: Path, bearing: str, seed: int) -> Path:
    return import_noise(folder / f"{bearing}_{seed}.mcap", seed, bearing=bearing)


def test_a_later_recording_of_another_bearing_is_refused(tmp_path: Path) -> None:
    runs = [recording(tmp_path, each, k) for k, each in enumerate(("HS130x230", "METRO120x220"))]
    with pytest.raises(InputError, match=r"METRO120x220_1.*the estimator is for HS130x230"):
        bd.follow(runs, taught(drawn(60, 2), runs=80))


def test_mileages_that_fall_are_refused() -> None:
    with pytest.raises(InputError, match="mileages: 0 m comes after"):
        bd.follow(["june.mcap", "may.mcap"], mileages=[1.2e7, 0.0])


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--at-km", "412000", "400000"], "--at-km: 400000 comes after 412000"),
        (["--at-km", "-1", "400000"], "--at-km: is -1; it must be at least 0"),
        (["--at-km", "400000"], "--at-km: has 1 numbers for 2 recordings"),
        (["--at-km", "1", "2", "--mileage-km", "1"], "--at-km, --mileage-km: both give the mileage"),
    ],
)
def test_mileages_that_cannot_be_are_refused_by_the_name_of_their_option(
    options: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command.main(["follow", "june.mcap", "may.mcap", *options]) == 2
    assert sentence in capsys.readouterr().err


@pytest.mark.slow
def test_the_command_counts_on_from_its_mileages_and_forecasts_without(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def beside(estimator: Estimator, rows: Float, *_: object) -> Residual:
        return residual_of(estimator, rows, rows)

    turned = Mounting(TURNED, ("x",), 25.0, 0.8)
    monkeypatch.setattr("beardyn_core.api.twin_residual.residual_beside", beside)
    monkeypatch.setattr("beardyn_core.follow.mounting_search.search_mountings", lambda *_: (turned,))
    runs = [str(recording(tmp_path, "HS130x230", seed)) for seed in (1, 2)]
    taught(drawn(60, 2), runs=80).save(tmp_path / "one.npz")
    every: list[dict[str, Any]] = []
    words = ["follow", *runs, "--estimator", str(tmp_path / "one.npz"), "--json"]
    at = ["--at-km", "400000", "412000", "--load-kn", "50:3", "60:3", "--twin", "smooth_run"]
    cases = ((at, 1.2e7), (["--widest-mm", "12"], 0.0))
    for options, begin in cases:
        assert command.main([*words, *options]) == 0
        told = json.loads(capsys.readouterr().out)
        every.append(told)
        assert len(told["steps"]) == 4
        assert 0.0 < told["steps"][2]["distance_m"] - begin < 500.0
    assert told["steps"][-1]["forecast"]["widest_m"] == pytest.approx(12e-3)
    check("follow", *every)
    assert every[0]["residual"]["explained"] == 1.0
    first, last = (every[0]["steps"][k]["forecast"]["rating"] for k in (0, -1))
    assert len(first["spans_m"]) == 1
    middle = pytest.approx(4.06e8, rel=1e-3)  # between both recordings
    assert last["spans_m"] == [[0.0, middle], [middle, pytest.approx(4.12e8, rel=1e-3)]]
    assert last["used_basic"][1] > first["used_basic"][1]
    assert every[1]["steps"][-1]["known_load"] is None
    assert every[1]["residual"] is None
    (found,) = every[0]["mountings"]
    assert (found["kind"], found["angle_deg"], found["recordings"]) == ("turned", 25.0, [0, 1])
