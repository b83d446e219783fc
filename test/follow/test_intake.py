"""What is received of a run: stretches at the estimator's rate, the command, runs that are refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.cli import main as command
from beardyn_core.follow.descriptors import AXES, describe, names_of
from beardyn_core.follow.estimate_json import mounting_object
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.inference import estimates_of, stretches_of
from beardyn_core.follow.mounting import TURNED, Mounting
from beardyn_core.follow.run_stretches import whole_bearing
from beardyn_core.follow.windowing import StretchIntake
from beardyn_core.measured.about import mounted_in
from beardyn_core.monitor.chain import Stretch
from beardyn_core.record.arrays import Signal, Turning
from test.cli.json_page import check
from test.follow.synthetic import PLATE, RATE, STRETCH, drawn, taught
from test.recordings import import_signal

SHAFT_HZ = 20.0
ORDERS = PLATE.frequencies


@pytest.fixture(scope="module")
def estimator() -> Estimator:
    return taught(drawn(60, 2), runs=80)


def signal(seconds: float, rate: float = RATE, axes: int = 3) -> Float:
    """Noise with a line at twice the rollers' passing on z, 3 m/s^2, shape [sample, axis]."""
    time = np.arange(round(seconds * rate)) / rate
    received = np.random.default_rng(1).normal(0.0, 0.5, (len(time), axes))
    received[:, -1] += 3.0 * np.sin(2.0 * np.pi * 2.0 * ORDERS.bpfo * SHAFT_HZ * time)
    return received


def measured(folder: Path, values: Float, rate: float = RATE) -> Path:
    """Make a recording of a measured file."""
    axes: dict[str, Any] = {"channels": "z=acceleration"} if values.shape[1] == 1 else {}
    return import_signal(folder / "run.mcap", values, rate=rate, speed_rpm=60.0 * SHAFT_HZ, **axes)


def turning(values: Float, speed_hz: float = SHAFT_HZ, rate: float = RATE) -> Any:
    """What is received of a run that begins a second after zero, whose shaft turns evenly."""
    time_ns = 1_000_000_000 + np.round(np.arange(len(values)) * 1e9 / rate).astype(np.int64)
    shaft_ns = np.arange(990_000_000, time_ns[-1] + 10_000_000, 2_500_000)
    angle = (2.0 * np.pi * speed_hz * 1e-9 * shaft_ns + np.pi) % (2.0 * np.pi) - np.pi
    signal = Signal(time_ns, values, AXES, "m/s^2", np.arange(len(values)))
    shaft = Turning(shaft_ns, angle, np.full(len(shaft_ns), 2.0 * np.pi * speed_hz))
    return SimpleNamespace(label="run", sensors={"box": signal}, vibration=signal, shaft=shaft)


def test_a_shaft_that_turns_backwards_is_received_as_if_forwards(estimator: Estimator) -> None:
    values = signal(1.6)
    run = turning(values, -SHAFT_HZ)
    intake = StretchIntake(estimator)
    intake.push_shaft(run.shaft.time_ns, run.shaft.angle)
    intake.push_vibration(run.vibration.time_ns, values)
    live = intake.stretch()
    assert live is not None
    for each in (next(stretches_of(run, estimator)), live):
        assert (np.diff(each.shaft_angle) > 0.0).all()
        np.testing.assert_array_equal(each.acceleration[::-1], values[: len(each.acceleration)])
        found = dict(zip(names_of(AXES), describe(each, ORDERS, PLATE, AXES), strict=True))
        assert found["passing_2_level_z"] == pytest.approx(20.0 * np.log10(3.0 / np.sqrt(2.0)), abs=0.1)
        assert found["shaft"] == pytest.approx(np.log10(SHAFT_HZ), abs=1e-3)


@pytest.mark.parametrize("first", ["vibration", "shaft"])
def test_what_the_other_stream_does_not_follow_is_forgotten(first: str, estimator: Estimator) -> None:
    run, intake = turning(signal(12.0)), StretchIntake(estimator)
    streams = {
        "vibration": (intake.push_vibration, run.vibration.time_ns, run.vibration.values),
        "shaft": (intake.push_shaft, run.shaft.time_ns, run.shaft.angle),
    }
    push, time_ns, values = streams.pop(first)
    for part in np.array_split(np.arange(len(time_ns)), 120):
        push(time_ns[part], values[part])
        assert intake.stretch() is None
    push, time_ns, values = next(iter(streams.values()))
    push(time_ns, values)
    found = intake.stretch()
    assert found is not None
    oldest = found.end_ns - round(1e9 * STRETCH)
    wanted = int(run.vibration.time_ns[-1]) - round(2e9 * STRETCH)
    assert oldest == pytest.approx(wanted, abs=110_000_000)  # a block is dropped whole
    assert found.shaft_frequency == pytest.approx(SHAFT_HZ, rel=1e-3)
    assert (intake.gaps, intake.unfit) == (0, 0)


def test_an_intake_says_why_it_receives_nothing(estimator: Estimator) -> None:
    values = signal(1.6)
    values[:, :2] = np.nan
    with pytest.raises(InputError, match="axis x is not measured; the estimator needs x, y, z: train one"):
        StretchIntake(estimator).push_vibration(turning(values).vibration.time_ns, values)
    intake, standing = StretchIntake(estimator), turning(signal(1.6), 0.0)
    assert not intake.doubt
    for run in (standing, turning(signal(1.6))):
        told = intake.doubt
        intake.push_shaft(run.shaft.time_ns, run.shaft.angle)
        intake.push_vibration(run.vibration.time_ns, run.vibration.values)
        found = intake.stretch()
        assert (found is None) == (run is standing)
    assert "of 1 stretches none is without NaN and has a shaft that turns 10 times" in told
    assert not intake.doubt


def test_lines_and_bands_have_the_levels_of_the_signal() -> None:
    values = signal(STRETCH)
    angle = np.asarray(2.0 * np.pi * SHAFT_HZ * np.arange(len(values)) / RATE, np.float64)
    found = dict(
        zip(
            names_of(AXES),
            describe(Stretch(RATE, values, angle, np.nan, 0), ORDERS, PLATE, AXES),
            strict=True,
        )
    )
    assert found["passing_2_level_z"] == pytest.approx(20.0 * np.log10(3.0 / np.sqrt(2.0)), abs=0.1)
    assert found["passing_2_lead_z"] > 30.0
    assert abs(found["passing_2_lead_x"]) < 20.0
    assert found["band_x_1000"] == pytest.approx(
        10.0 * np.log10(0.25 * 1000.0 * (2 ** (1 / 6) - 2 ** (-1 / 6)) / (RATE / 2.0)), abs=1.0
    )
    assert found["shaft"] == pytest.approx(np.log10(SHAFT_HZ), abs=1e-3)


@pytest.mark.parametrize(
    ("rate", "seconds", "count"), [(RATE, 4.6, 3), (2.0 * RATE, 3.1, 2), (RATE, 1.46, 1)]
)
def test_a_run_is_received_in_whole_stretches_at_the_rate_learnt(
    rate: float, seconds: float, count: int, tmp_path: Path, estimator: Estimator
) -> None:
    run = bd.read(measured(tmp_path, signal(seconds, rate), rate))
    found = list(stretches_of(run, estimator))
    assert len(found) == count
    for each in found:
        assert each.rate == RATE
        assert each.shaft_frequency == pytest.approx(SHAFT_HZ, rel=1e-3)
        kept = np.sqrt(np.mean(each.acceleration[:, 2] ** 2))
        assert kept == pytest.approx(np.sqrt(4.5 + 0.25 * min(1.0, RATE / rate)), rel=0.02)


@pytest.mark.parametrize("rate", [RATE, 2.0 * RATE])
@pytest.mark.parametrize("dropped", [True, False])
def test_a_stretch_begins_anew_where_samples_are_lost(
    rate: float, dropped: bool, estimator: Estimator
) -> None:
    whole = turning(signal(4.7, rate), rate=rate)
    time_ns, values = whole.vibration.time_ns, whole.vibration.values.copy()
    here = (time_ns < 2_600_000_000) | (time_ns >= 2_900_000_000)
    values[~here, 0] = np.nan
    kept = here | (not dropped)
    signals = Signal(time_ns[kept], values[kept], AXES, "m/s^2", np.flatnonzero(kept))
    run: Any = SimpleNamespace(label="run", sensors={"box": signals}, vibration=signals, shaft=whole.shaft)
    ends = [each.end_ns for each in stretches_of(run, estimator)]
    assert ends == pytest.approx([2_500_000_000, 4_400_000_000], abs=50_000)
    for each, end_ns in zip(stretches_of(run, estimator), ends, strict=True):
        assert each.shaft_frequency == pytest.approx(SHAFT_HZ, rel=1e-3)
        sent = np.interp(end_ns, run.shaft.time_ns, np.unwrap(run.shaft.angle))
        assert each.shaft_angle[-1] == pytest.approx(sent, abs=0.02)
        assert np.diff(each.shaft_angle).max() < 1.1 * 2.0 * np.pi * SHAFT_HZ / RATE


def test_one_lost_sample_makes_a_run_too_short(estimator: Estimator) -> None:
    run = turning(signal(2.0, 2.0 * RATE), rate=2.0 * RATE)
    run.vibration.values[51_200, 1] = np.nan
    with pytest.raises(InputError, match="of whole vibration"):
        estimates_of(run, estimator, PLATE)


@pytest.mark.slow
def test_command_tells_what_the_function_finds(
    tmp_path: Path, estimator: Estimator, capsys: pytest.CaptureFixture[str]
) -> None:
    path, file = measured(tmp_path, signal(3.1)), tmp_path / "one.npz"
    estimator.save(file)
    found = bd.estimate(path, file)
    assert command.main(["estimate", str(path), "--estimator", str(file)]) == 0
    assert capsys.readouterr().out.splitlines() == found.sentences
    forecast = ["--mileage-km", "200000", "--bearing", "HS130x230"]
    assert command.main(["estimate", str(path), "--estimator", str(file), *forecast]) == 0
    assert "rating life" in capsys.readouterr().out
    words = ["estimate", str(path), "--estimator", str(file), "--json", *forecast]
    assert command.main(words) == 0
    told = json.loads(capsys.readouterr().out)
    assert command.main([*words, "--load-kn", "70:3", "--temperature-c", "50:60"]) == 0
    known = json.loads(capsys.readouterr().out)
    mounted = {**told, "mountings": [mounting_object(Mounting(TURNED, ("x",), 20.0, 0.9))]}
    check("estimate", told, known, mounted)
    assert known["known_load"]["value_N"] == known["estimates"]["vertical_load_N"]["value"]
    assert known["forecast"]["rating"]["temperature_is_stated"]
    assert known["forecast"]["rating"]["temperature_K"] == [323.15, 333.15]
    assert told["known_load"] is None
    assert told["forecast"]["rating"] is None
    load = told["estimates"]["vertical_load_N"]
    assert (load["value"] or np.nan, load["reason"]) == pytest.approx(
        (found["vertical_load"].value, found["vertical_load"].reason), nan_ok=True
    )
    assert told["stretches"] == 2


@pytest.mark.parametrize(
    ("seconds", "rate", "axes", "options", "sentence"),
    [
        (1.0, RATE, 3, {}, "has no 1.50 s of whole vibration"),
        (2.0, 12_800.0, 3, {}, "is sampled at 12800 Hz"),
        (2.0, RATE, 1, {}, "axis x is not measured"),
        (2.0, RATE, 3, {"bearing": "METRO120x220"}, "the estimator is for HS130x230"),
        (2.0, RATE, 3, {"sensor": "bottom"}, "has no sensor 'bottom'"),
    ],
)
def test_runs_that_cannot_be_received_are_refused(
    seconds: float, rate: float, axes: int, options: dict[str, Any], sentence: str,
    tmp_path: Path, estimator: Estimator,
) -> None:  # fmt: skip
    path = measured(tmp_path, signal(seconds, rate, axes), rate)
    with pytest.raises(InputError, match=sentence):
        bd.estimate(path, estimator, **options)


def test_options_of_a_forecast_that_cannot_be_are_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert command.main(["estimate", "no.mcap", "--mileage-km", "-1", "--growth-mm2", "0"]) == 2
    told = capsys.readouterr().err
    assert "--mileage-km: is -1; it must be at least 0" in told
    assert "--growth-mm2: is 0; it must be above 0" in told


@pytest.mark.parametrize("name", ["HS130x230", "WJ130x240", "SRB130x280"])
def test_an_imported_file_keeps_the_kind_of_its_bearing(name: str, tmp_path: Path) -> None:
    """Or an estimator of another kind with such rollers might be taken for it."""
    path = import_signal(tmp_path / "run.mcap", signal(0.2), bearing=name)
    (mounted,) = mounted_in(bd.read(path).measured, "run")
    assert mounted.plate.kind == bd.bearing(name).kind
    assert mounted.plate.has_barrels is (name == "SRB130x280")


def test_a_shipped_bearing_is_that_of_its_data_and_not_of_its_name() -> None:
    """Or the life of another bearing would be reported without a word."""
    plate = NamePlate.of(bd.bearing("HS130x230"))
    found = whole_bearing(plate)
    assert found is not None
    assert found.name == "HS130x230"
    for other in (
        replace(plate, roller_count=plate.roller_count + 1),
        replace(plate, kind="cylindrical"),
        replace(plate, name="mine"),
    ):
        assert whole_bearing(other) is None


def test_a_bearing_without_an_estimator_gets_the_command_that_makes_one(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"`beardyn train --bearing AARK_6\.5x9` makes one"):
        bd.estimate(measured(tmp_path, signal(2.0)), bearing="AARK_6.5x9")
