"""The page of the fast tier: what a level misses, where, and how its scenes are counted."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from beardyn_core.choice.load import scene_with_all
from beardyn_core.study.ladder_result import Cost, LevelResult, Part, QuantityError
from evidence.automatic import fast_tier
from evidence.automatic.page import keep_bands
from evidence.pages import render


def case(**changes: Any) -> dict[str, Any]:
    return {
        "scene": "smooth_run",
        "tier": "quasistatic",
        "laminae": 6,
        "steps": 1,
        "status": "complete",
        "bands": {"1000": "0.3", "5000": "(0.4)", "8000": "1.9"},
        "loudest": "-1.9 ± 0.2 at 8000 Hz",
        "means": {"force": "0.10 %", "deflection": "0.20 %", "roller_load": "0.30 %", "torque": "2.5 %"},
        "verdict": "no",
        "of_means": "yes",
        "seconds": 0.1,
        "faster": 4.0,
        "day": "2026-11-30",
    } | changes


def test_both_tiers_are_chosen_for_8_kHz_and_only_the_fast_one_is_made_to_couple_its_slices() -> None:
    one, two, four, full = fast_tier.levels("smooth_run")
    assert (one.steps_per_sample, two.steps_per_sample, four.steps_per_sample) == (1, 2, 4)
    assert one.effects == two.effects == four.effects
    assert one.effects.lamina_coupling is not None
    assert {one.tier, two.tier, four.tier} == {"quasistatic"}
    assert full.tier == "full"
    assert full.effects.structure is not None
    assert scene_with_all("smooth_run").effects.structure is not None


def test_the_farthest_third_octave_is_named_with_its_doubt_up_to_a_frequency() -> None:
    parts = (
        Part("1000 Hz", 0.4, 0.1, 0.2),
        Part("8000 Hz", -1.9, 0.1, 0.2),
        Part("10000 Hz", 5.0, 0.1, 0.2),
    )
    level = next(iter(fast_tier.levels("smooth_run")))
    error = QuantityError("vibration", "dB", parts)
    row = LevelResult(level, 6, Cost(0.1, 0.1, 0.1), (error,), (), "complete")
    assert fast_tier._where(keep_bands(row, 8000.0)) == "-1.9 ± 0.2 at 8000 Hz"
    assert fast_tier._where(keep_bands(row, 1000.0)) == "+0.4 ± 0.2 at 1000 Hz"


def test_scenes_are_counted_for_each_step() -> None:
    cases = [
        case(),
        case(scene="cup_spall", verdict="yes", faster=6.0),
        *(case(steps=steps, verdict="open", of_means="no") for steps in (2, 4)),
        case(tier="full", steps=3),
    ]
    one, two, _ = fast_tier.sum_up(cases)
    assert "1.5 dB in 1 of 2 scenes (0 open)" in one
    assert "4.0 to 6.0 times as fast" in one
    assert "0 of 1 scenes (1 open)" in two
    assert "within 5 % in 0" in two


def test_the_page_has_a_row_for_each_level(tmp_path: Path) -> None:
    values = {
        "laminae": 40,
        "steps": 8,
        "runs": 6,
        "limit_dB": 1.5,
        "limit": 5.0,
        "to": 8.0,
        "processor": "a processor",
        "summary": ["a line"],
        "rows": [fast_tier.cells(case()), fast_tier.cells(case(tier="full", steps=3))],
    }
    text = render(fast_tier.__file__, values)
    assert "| `smooth_run` | `quasistatic`, 6 x 1 | 0.3 | (0.4) | 1.9 | -1.9 ± 0.2 at 8000 Hz | no |" in text
    assert "| `smooth_run` | `full`, 6 x 3 |" in text
