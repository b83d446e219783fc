"""A sensor that is not mounted as stated is recognised by what makes its signal familiar again."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.fft import irfft, rfft

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.descriptors import AXES, FINE, band_levels, names_of, places_of
from beardyn_core.follow.estimate_json import estimates_object
from beardyn_core.follow.estimator import Estimates, Estimator
from beardyn_core.follow.familiarity import familiarity_of
from beardyn_core.follow.inference import estimates_of
from beardyn_core.follow.mounting import EXCHANGED, GAIN, TURNED, Mounting, lasting_mountings
from beardyn_core.follow.mounting_search import (
    cross_powers,
    mountings_of,
    search_mountings,
    strangeness_of,
)
from beardyn_core.follow.mounting_watch import LATEST, MountingWatch
from beardyn_core.monitor.chain import Stretch
from test.follow.synthetic import PLATE
from test.follow.test_intake import turning
from test.recordings import import_signal

RATE, SAMPLES = 6400.0, 6400
RINGS = (
    (420.0, (1.0, 0.1, 0.4)),
    (900.0, (0.3, 1.0, 0.0)),
    (1700.0, (0.1, 0.5, 1.0)),
)  # [Hz], along the axes
TURN, LOUD = Mounting(TURNED, ("x",), 25.0, 0.8), Mounting(GAIN, AXES, 20.0, 0.9)


def received(seed: int) -> Stretch:
    """Noise of a box with three modes, each with a direction of its own."""
    draw = np.random.default_rng(seed)
    frequency = np.arange(SAMPLES // 2 + 1) * RATE / SAMPLES
    found = 0.05 * draw.normal(size=(SAMPLES, 3))
    for ring, along in RINGS:
        mode = 1.0 / (1.0 + ((frequency / ring - ring / np.maximum(frequency, 1.0)) * 8.0) ** 2)
        excited = irfft(rfft(draw.normal(size=SAMPLES)) * mode, SAMPLES) * 10.0 ** (
            draw.normal(0.0, 1.0) / 20.0
        )
        found += excited[:, None] * np.array(along)
    angle: Float = 60.0 * np.arange(SAMPLES, dtype=float) / RATE
    return Stretch(RATE, found, angle, np.nan, 0)


@cache
def learnt() -> Estimator:
    """An estimator that knows the levels of such boxes, and nothing else of them."""
    names, rows = names_of(AXES), np.full((130, len(names_of(AXES))), np.nan)
    for k, row in enumerate(rows):
        for axis, signal in zip(AXES, (received(k).acceleration).T, strict=True):
            levels = band_levels(signal - signal.mean(), RATE, FINE, 12)
            for frequency, level in levels.items():
                row[names.index(f"fine_{axis}_{frequency:.0f}")] = level
    box = places_of(AXES, "box")
    middle: Float = np.zeros(len(names))
    spread: Float = np.ones(len(names))
    middle[box], spread[box] = rows[:, box].mean(axis=0), rows[:, box].std(axis=0)
    standard = np.nan_to_num((rows - middle) / spread)
    familiar = familiarity_of(standard[:100], box).set_bound(standard[100:])
    plate = PLATE if isinstance(PLATE, NamePlate) else NamePlate.of(PLATE)
    return Estimator(
        plate, AXES, RATE, 1.0, middle, spread, familiar, familiar, {}, None, None, {"quantities": {}}
    )


def mounted(seed: int, matrix: Float) -> Stretch:
    """What a sensor receives whose axes are a matrix times those stated."""
    usual = received(seed)
    return replace(usual, acceleration=usual.acceleration @ matrix.T)


def turned(degrees: float) -> Float:
    """Give the axes, as rows, of a sensor that is turned about x: its y towards z, by the right hand."""
    along_y, along_z = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[1.0, 0.0, 0.0], cosine * along_y + sine * along_z, cosine * along_z - sine * along_y])


def test_powers_of_bands_are_the_levels_that_an_estimator_receives() -> None:
    stretch = received(1)
    powers = np.diagonal(cross_powers(stretch), axis1=1, axis2=2)
    for axis in range(3):
        signal = stretch.acceleration[:, axis]
        expected = list(band_levels(signal - signal.mean(), RATE, FINE, 12).values())
        np.testing.assert_allclose(10.0 * np.log10(powers[:, axis]), expected, atol=1e-9)


@pytest.mark.parametrize("seed", range(1000, 1005))
@pytest.mark.parametrize(
    ("matrix", "kind", "axes", "amount"),
    [
        (np.eye(3)[[0, 2, 1]], "exchanged", ("x", "z", "y"), 0.0),
        (np.eye(3)[[1, 2, 0]], "exchanged", ("y", "z", "x"), 0.0),
        (turned(25.0), "turned", ("x",), 25.0),
        (turned(-40.0), "turned", ("x",), -40.0),
        (10.0 * np.eye(3), "gain", AXES, 20.0),
        (np.diag([1.0, 0.25, 1.0]), "gain", ("y",), -12.0),
    ],
)
def test_a_mistake_of_mounting_is_named_with_its_amount(
    matrix: Float, kind: str, axes: tuple[str, ...], amount: float, seed: int
) -> None:
    found = mountings_of([mounted(seed, matrix), mounted(seed + 50, matrix)], learnt())
    assert (found[0].kind, found[0].axes) == (kind, axes), found
    assert found[0].amount == pytest.approx(amount, abs=4.0 if kind == "turned" else 1.0)
    assert found[0].strangeness <= 1.0


def test_what_is_familiar_or_of_another_box_is_no_mistake_of_mounting() -> None:
    kept = [seed for seed in range(2000, 2020) if not mountings_of([received(seed)], learnt())]
    assert len(kept) == 20
    other = received(5).acceleration
    lines = rfft(other, axis=0) * (1.0 + 3.0 * np.sin(np.arange(SAMPLES // 2 + 1) / 40.0) ** 2)[:, None]
    strange = replace(received(5), acceleration=irfft(lines, SAMPLES, axis=0))
    assert strangeness_of([strange], learnt()) > 1.0
    assert mountings_of([strange], learnt()) == ()
    dead = received(5).acceleration * np.array([1.0, 0.0, 1.0])
    assert mountings_of([replace(received(5), acceleration=dead)], learnt()) == ()


def test_an_estimator_of_one_axis_knows_no_mounting() -> None:
    assert mountings_of([received(1)], replace(learnt(), axes=("z",))) == ()


@pytest.mark.parametrize(
    ("mounting", "sentence", "angle", "gain"),
    [
        (
            Mounting(EXCHANGED, ("y", "x", "z"), 0.0, 0.8),
            "its channels are y, x, z in place of x, y, z",
            None,
            None,
        ),
        (Mounting(TURNED, ("x",), -24.6, 0.8), "it is turned by -25° about x", -24.6, None),
        (
            Mounting(GAIN, AXES, 20.0, 0.8),
            "the gain of all axes is off by +20.0 dB (a factor of 10)",
            None,
            20.0,
        ),
        (
            Mounting(GAIN, ("y",), -6.0, 0.8),
            "the gain of axis y is off by -6.0 dB (a factor of 0.501)",
            None,
            -6.0,
        ),
    ],
)
def test_a_mounting_is_told_in_text_and_json(
    mounting: Mounting, sentence: str, angle: float | None, gain: float | None
) -> None:
    found = Estimates(None, (), 3.2, 1, 10.0, mountings=(mounting,))
    assert sentence in found.sentences[-1]
    (told,) = estimates_object(found)["mountings"]
    assert (told["kind"], told["angle_deg"], told["gain_dB"]) == (mounting.kind, angle, gain)


def test_a_run_with_exchanged_channels_is_told_so() -> None:
    """Through `estimates_of`, as the command takes it."""
    stretches = [mounted(1001, np.eye(3)[[0, 2, 1]]), mounted(1002, np.eye(3)[[0, 2, 1]])]
    values = np.concatenate([each.acceleration for each in stretches])
    found = estimates_of(turning(values, rate=RATE), learnt(), learnt().plate)
    assert found.strangeness > 1.0
    assert found.mountings[0].axes == ("x", "z", "y")
    usual = np.concatenate([received(seed).acceleration for seed in (1001, 1002)])
    assert estimates_of(turning(usual, rate=RATE), learnt(), learnt().plate).mountings == ()


@pytest.mark.parametrize(
    ("found", "lasting"),
    [
        ([(TURN,)], [(0,)]),
        ([(), (TURN,), (TURN,)], [(1, 2)]),  # mounted anew after the first recording
        ([(TURN,), (TURN,), (), (TURN,)], [(0, 1, 3)]),
        ([(), (), (TURN,)], []),  # one recording may be strange for another reason
        ([(TURN,), (TURN,), (), ()], []),
        ([(TURN,), (replace(TURN, amount=40.0),), (replace(TURN, amount=-30.0),)], []),
        ([(TURN, LOUD), (LOUD,), (LOUD, TURN), (TURN,), (LOUD,)], [(0, 1, 2, 4), (0, 2, 3)]),
        ([], []),
    ],
)
def test_what_lasts_is_found_in_most_recordings_since_the_first(
    found: list[tuple[Mounting, ...]], lasting: list[tuple[int, ...]]
) -> None:
    assert [each.recordings for each in lasting_mountings(found)] == lasting


def test_a_lasting_mounting_has_the_middle_of_its_amounts_and_names_its_recordings() -> None:
    amounts = (22.0, 25.0, 24.0)
    (found,) = lasting_mountings([(), *((replace(TURN, amount=each),) for each in amounts)])
    assert found.mounting.amount == 24.0
    assert found.sentence_of(4) == "it is turned by 24° about x, in recordings 2, 3, 4 of 4"
    assert found.sentence_of(3).endswith("in all 3 recordings")
    assert lasting_mountings([(TURN,)])[0].sentence_of(1) == TURN.sentence


def test_recordings_with_exchanged_channels_are_told_once(tmp_path: Path) -> None:
    learnt().save(tmp_path / "one.npz")
    runs = []
    for number, matrix in enumerate((np.eye(3), np.eye(3)[[0, 2, 1]], np.eye(3)[[0, 2, 1]])):
        values = np.concatenate([mounted(1000 + 10 * number + k, matrix).acceleration for k in range(2)])
        runs.append(import_signal(tmp_path / f"{number}.mcap", values, rate=RATE, speed_rpm=1200.0))
    found = bd.follow(runs, tmp_path / "one.npz")
    assert [(each.mounting.axes, each.recordings) for each in found.mountings] == [(("x", "z", "y"), (1, 2))]
    told = [each for each in found.sentences if "check mounting" in each]
    assert told == [
        "check mounting and gain of the sensor: the signal would be familiar if its channels are x, z, y in "
        "place of x, y, z, in recordings 2, 3 of 3"
    ]
    assert bd.follow(runs[:1], tmp_path / "one.npz").mountings == ()


def test_a_live_watch_searches_when_it_is_due_and_forgets_what_has_gone() -> None:
    watch, wrong = MountingWatch(learnt()), np.eye(3)[[0, 2, 1]]
    watch.take(mounted(1001, wrong))
    assert not watch.due()  # one may be strange for another reason
    watch.take(mounted(1002, wrong))
    powers = watch.due()
    assert len(powers) == 2
    assert not watch.due()
    watch.found = search_mountings(powers, learnt())
    assert "its channels are x, z, y in place of x, y, z" in watch.sentence
    for seed in range(1003, 1003 + LATEST):
        watch.take(mounted(seed, wrong))
    assert len(watch.due()) == LATEST
    for seed in range(2000, 2000 + LATEST):
        watch.take(received(seed))
    assert not watch.sentence
    assert not watch.due()
    alone = MountingWatch(replace(learnt(), axes=("z",)))
    for seed in range(2):
        alone.take(replace(received(seed), acceleration=100.0 * received(seed).acceleration[:, 2:]))
    assert not alone.due()
