"""Field spalls: what is drawn of them, the strips that a roller meets, and a run over one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from beardyn_core.api.making import scene as make_scene
from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene
from beardyn_core.config.nouns import load_bearing
from beardyn_core.run import blocks
from beardyn_core.scene.defect import Defect, defect_from, truth_of
from beardyn_core.scene.field_spall import PARTS, STAGES, FieldSpall, width_of_stage
from beardyn_core.scene.patch import Patch

BEARING = load_bearing("HS130x230")
LINE = BEARING.effective_length


def spall(width: float, seed: int = 1, on: str = "cup") -> FieldSpall:
    return FieldSpall(on, 0, 0.0, width, LINE, seed=seed)


@settings(max_examples=40, deadline=None)
@given(some.floats(5e-4, 8e-2), some.integers(0, 10_000), some.floats(20e-3, LINE))
def test_it_is_as_wide_as_asked_and_stays_on_the_roller(width: float, seed: int, line: float) -> None:
    found = replace(spall(width, seed), length=line)
    _, low, high, _ = found.outline
    assert high.max() - low.min() == pytest.approx(width, rel=1e-6)
    assert (high > low).all()
    length, middle = found.extent
    assert length <= line * (1.0 + 1e-9)
    assert abs(middle) + 0.5 * length <= 0.5 * line * (1.0 + 1e-9)
    for patch in found.patches(BEARING):
        assert not list(patch.contradictions(BEARING))
        assert not list(patch.rules())


@settings(max_examples=30, deadline=None)
@given(some.floats(1e-3, 4e-2), some.floats(1.05, 2.0), some.integers(0, 10_000))
def test_a_wider_one_contains_a_narrower_one(width: float, more: float, seed: int) -> None:
    small, large = spall(width, seed).outline, spall(more * width, seed).outline
    there = np.searchsorted(large.place, small.place - 1e-9)
    np.testing.assert_allclose(large.place[there], small.place, atol=1e-9)
    assert (large.low[there] <= small.low + 1e-12).all()
    assert (large.high[there] >= small.high - 1e-12).all()


@pytest.mark.slow
@pytest.mark.parametrize("stage", range(1, len(STAGES) + 1))
def test_widths_and_lengths_of_a_stage_have_its_medians(stage: int) -> None:
    """Of 200 spalls; the length is cut off by the contact."""
    widths = np.array([width_of_stage(stage, seed) for seed in range(200)])
    assert np.median(widths) == pytest.approx(STAGES[stage - 1].width, rel=0.08)
    assert np.std(np.log(widths)) == pytest.approx(0.3, abs=0.05)
    lengths = [spall(STAGES[stage - 1].width, seed).extent[0] for seed in range(200)]
    expected = min(STAGES[stage - 1].length, LINE)
    assert np.median(lengths) == pytest.approx(expected, rel=0.2, abs=0.2e-3)  # a cell is 0.25 mm


@pytest.mark.parametrize("width", [3e-3, 12e-3, 40e-3])
def test_strips_have_the_area_of_the_outline(width: float) -> None:
    found = spall(width)
    strips = [patch for patch in found.patches(BEARING) if patch.kind == "spall"]
    assert len(strips) <= PARTS
    assert sum(each.width * each.length for each in strips) == pytest.approx(found.area, rel=0.02)
    ends = np.array([(each.offset - 0.5 * each.length, each.offset + 0.5 * each.length) for each in strips])
    np.testing.assert_allclose(ends[1:, 0], ends[:-1, 1], atol=1e-9)


def test_pits_and_dents_come_one_after_the_other() -> None:
    """None of them goes or changes its size as the spall grows; it may push them away."""
    for seed in range(30):
        small, large = (spall(width, seed).patches(BEARING) for width in (6e-3, 30e-3))
        for kind in ("elliptic", "dent"):
            before, after = ([each.width for each in all_ if each.kind == kind] for all_ in (small, large))
            assert after[: len(before)] == before


def test_it_goes_into_a_recording_and_back() -> None:
    found = spall(9e-3, 5)
    truth = truth_of(found, 0.0)
    assert truth["drawn"]["area"] == pytest.approx(found.area)
    assert defect_from(truth) == found


@pytest.mark.parametrize("keys", [{}, {"width_mm": 6.0, "stage": 2.0}])
def test_width_or_stage(keys: dict[str, float]) -> None:
    with pytest.raises(InputError, match="give either `width_mm` or `stage`"):
        make_scene("smooth_run", defects=[{"kind": "field_spall", "on": "cup", "row": 0, **keys}])


def loudness(defect: Defect) -> float:
    """Rms above 2 kHz of a short run in tier lumped, [m/s^2]."""
    scene = replace(
        load_scene("cup_spall", tier="lumped", effects="all"), defects=(defect,), waviness=(), scatter=None
    )
    quiet = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    measured = [block.acceleration[0][:, 2] for block in blocks(replace(scene, sensors=quiet), 0.4)]
    signal = np.concatenate(measured)[2560:]
    power = np.abs(np.fft.rfft(signal * np.hanning(len(signal)))) ** 2
    return float(np.sqrt(power[np.fft.rfftfreq(len(signal), 1 / 25_600.0) > 2000.0].sum()))


def test_a_field_spall_strikes_less_than_a_slot_as_wide_across_the_raceway() -> None:
    """A third and less: rollers lose their support on a part of their length, and not all of it at once."""
    slot = loudness(Patch("cup", 0, 0.0, 9e-3, 150e-6, LINE))
    fields = [loudness(spall(9e-3, seed)) for seed in (1, 2, 3)]
    assert max(fields) < 0.5 * slot
    assert len(set(fields)) == 3
