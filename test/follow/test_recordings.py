"""One bearing followed over several recordings: what goes on, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.cli import main as command
from beardyn_core.errors import InputError
from test.follow.synthetic import RATE, drawn, taught


def recording(folder: Path, bearing: str, seed: int, seconds: float = 3.2) -> Path:
    """Make a recording of noise that is measured on a bearing."""
    noise = np.random.default_rng(seed).normal(0.0, 1.0, (round(seconds * RATE), 3))
    np.savez(folder / "measured.npz", acceleration=noise, fs=RATE)
    return bd.import_measured(
        folder / "measured.npz", folder / f"{bearing}_{seed}.mcap", bearing=bearing, unit="m/s2",
        speed_rpm=1200.0,
    )  # fmt: skip


def test_a_later_recording_of_another_bearing_is_refused(tmp_path: Path) -> None:
    runs = [recording(tmp_path, each, k) for k, each in enumerate(("HS130x230", "METRO120x220"))]
    with pytest.raises(InputError, match=r"METRO120x220_1.*the estimator is for HS130x230"):
        bd.follow(runs, taught(drawn(60, 2), runs=80))


def test_mileages_that_fall_are_refused() -> None:
    with pytest.raises(InputError, match="mileages: 0 m comes after"):
        bd.follow(["june.mcap", "may.mcap"], mileages=[1.2e7, 0.0])


def test_the_option_of_mileages_that_fall_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["follow", "june.mcap", "may.mcap", "--at-km", "412000", "400000"]) == 2
    assert "--at-km: 400000 comes after 412000" in capsys.readouterr().err
