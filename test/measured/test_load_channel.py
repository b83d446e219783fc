"""A channel of measured files with the load: it is no axis, has a unit, and an estimate knows its mean."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.api.estimating import known_load_in
from beardyn_core.base.errors import InputError
from beardyn_core.record.reading import read_run
from test.measured.files import RATE, noise, table

COUNT = 6000


def columns(force: float = 71.0, name: str = "Fz [kN]") -> dict[str, np.ndarray]:
    swing = 5.0 * np.sin(2.0 * np.pi * np.arange(COUNT) / 100.0)
    return {"time_s": np.arange(COUNT) / RATE, "az [g]": noise(COUNT)[:, 0], name: force + swing}


def test_the_mean_of_the_channel_is_kept_and_known(tmp_path: Path) -> None:
    path, recording = table(tmp_path / "a.csv", columns()), tmp_path / "a.mcap"
    stated: dict[str, Any] = {"speed_rpm": 1200.0, "load_channel": "Fz*", "load_error_percent": 4.0}
    bd.import_measured(path, recording, bearing="HS130x230", **stated)
    for run in (read_run(recording), bd.read_measured(path, **stated)):
        load = run.measured["load"]
        assert load["mean_N"] == pytest.approx(71e3, rel=1e-6)
        assert load["rms_about_mean_N"] == pytest.approx(5e3 / np.sqrt(2.0), rel=1e-3)
        known = known_load_in(run, None, ())
        assert known is not None
        assert (known.value, known.half_width) == pytest.approx((71e3, 0.04 * 71e3))
        assert "Fz" in known.source
        assert len(run.sensors) == 1  # the load is no accelerometer
        contradicted = known_load_in(run, "95:2", ())
        assert contradicted is not None
        assert "contradict" in contradicted.doubts[0]


def test_without_the_option_no_load_is_known(tmp_path: Path) -> None:
    given = {key: each for key, each in columns().items() if "Fz" not in key}
    run = bd.read_measured(table(tmp_path / "a.csv", given), speed_rpm=1200.0)
    assert run.measured["load"] is None
    assert known_load_in(run, None, ()) is None


def test_a_channel_without_a_unit_is_asked_for_and_one_that_is_no_load_refused(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", columns(name="wheel"))
    with pytest.raises(InputError, match="load_unit, one of N, kN, t, kg"):
        bd.read_measured(path, speed_rpm=1200.0, load_channel="wheel")
    run = bd.read_measured(path, speed_rpm=1200.0, load_channel="wheel", load_unit="N")
    with pytest.raises(InputError, match="check load_unit"):
        known_load_in(run, None, ())
    with pytest.raises(InputError, match="which is not given"):
        bd.read_measured(path, speed_rpm=1200.0, load_unit="kN")
    with pytest.raises(InputError, match="no channel of the file"):
        bd.read_measured(path, speed_rpm=1200.0, load_channel="other")
