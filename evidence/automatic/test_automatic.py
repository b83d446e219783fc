"""The pages of the automatic choices say what was chosen and how it turned out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.choice import discretisation_error, friction, load_scene
from beardyn_core.choice.load import explain_scene
from beardyn_core.config import load_effects
from beardyn_core.study.ladder_levels import chosen_for
from beardyn_core.study.ladder_result import Cost, LevelResult, Part, QuantityError
from beardyn_core.study.measures import NOMINAL_BANDS
from evidence.automatic import bands, page, shipped, torque
from evidence.automatic.page import row
from evidence.standard import standard_scene


def test_a_row_shows_what_was_found_beside_what_was_expected() -> None:
    case = {
        "scene": "static_80kN",
        "asked": ["torque"],
        "accuracy": 0.05,
        "to": None,
        "tier": "full",
        "laminae": 6,
        "steps_per_sample": 4,
        "effects": ["film", "rib"],
        "missing": ["drag"],
        "simpler": [],
        "found": {"torque": "1.2 %"},
        "expected": {"torque": "2"},
        "status": "complete",
        "verdict": "yes",
        "longer": 1,
        "day": "2026-11-30",
    }
    assert row(case) == (
        "| `static_80kN` | torque at 5 % | full, 6 laminae x 4: all less drag | torque 1.2 % (*2*) | yes "
        "| 2026-11-30 |"
    )
    assert "| torque to 1 kHz at 5 % |" in row({**case, "to": 1000.0})
    assert "torque 1.2 % (*2*); it stopped | yes | 2026-11-30 |" in row({**case, "status": "it stopped"})
    assert "all less drag; simpler rib | torque" in row({**case, "simpler": ["rib"]})
    undecided = {**case, "asked": ["vibration"], "verdict": "open", "longer": 3}
    undecided |= {name: {"vibration": "1"} for name in ("found", "expected")}
    undecided["doubt"] = {"vibration": "40 Hz: +1 ± 2 dB"}
    assert row(undecided).endswith("| open, 3 times as long (40 Hz: +1 ± 2 dB) | 2026-11-30 |")


def test_rows_of_other_scenes_stay_on_the_page() -> None:
    old = "# Title\n\n| scene |\n|---|\n| `cup_spall` | a |\n| `static_5kN` | b |\n| `gone` | c |\n"
    assert page.merged(old, "cup_spall", ["| `cup_spall` | d |", "| `cup_spall` | e |"]) == [
        "| `static_5kN` | b |",
        "| `cup_spall` | d |",
        "| `cup_spall` | e |",
    ]
    assert page.merged("", "static_5kN", ["| `static_5kN` | f |"]) == ["| `static_5kN` | f |"]


def test_a_kept_result_is_of_all_that_was_chosen_and_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = standard_scene("static_5kN")
    choice = chosen_for(scene, 0.05, ("force", "torque"))
    kept = page.digest_of(scene, [choice])
    assert kept == page.digest_of(scene, [choice])
    cage: Any = load_effects("all").cage
    cage = replace(cage, lubrication=None)
    for other in (
        replace(choice, laminae=20),
        replace(choice, steps_per_sample=5),
        replace(choice, effects=replace(choice.effects, cage=cage)),
    ):
        assert page.digest_of(scene, [other]) != kept
    for case in (page.Case(("force",), 0.01), page.Case(("force", "torque"), 0.05, 1000.0)):
        monkeypatch.setitem(page.CASES, "static_5kN", (case,))
        assert page.digest_of(scene, [choice]) != kept


def test_third_octaves_above_what_is_asked_for_do_not_count() -> None:
    parts = tuple(Part(f"{band:g} Hz", 0.1 if band <= 1000 else 9.0, 0.0, 0.0) for band in NOMINAL_BANDS)
    errors = (
        QuantityError("torque", "%", (Part("mean", 0.2, 0.0, 0.0),)),
        QuantityError("vibration", "dB", parts),
    )
    level: Any = None
    row = LevelResult(level, 1, Cost(1.0, 1.0, 1.0), errors, (), "complete")
    assert page.keep_bands(row, None).verdict(("vibration",), 0.05) == "no"
    assert page.keep_bands(row, 1000.0).verdict(("vibration",), 0.05) == "yes"
    assert page.keep_bands(row, 1250.0).verdict(("vibration",), 0.05) == "no"
    assert page.keep_bands(row, 1000.0).of("torque") == errors[0]


def test_what_is_kept_is_not_run_again_and_an_open_case_is_run_longer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[tuple[list[int], int]] = []

    def tried(_scene: object, _choices: object, chosen: Sequence[int], longer: int) -> list[dict[str, Any]]:
        ran.append((list(chosen), longer))
        open_cases = [1] if longer == 1 else []
        return [{"verdict": "open" if k in open_cases else "yes", "longer": longer} for k in chosen]

    monkeypatch.setattr(page, "tried", tried)
    scene = "static_80kN"
    assert [case["verdict"] for case in page.Kept(tmp_path).cases(scene)] == ["yes", "open", "yes"]
    found = page.Kept(tmp_path).cases(scene, 3)
    assert [(case["verdict"], case["longer"]) for case in found] == [("yes", 1), ("yes", 3), ("yes", 1)]
    assert ran == [([0, 1, 2], 1), ([1], 3)]


def test_a_shipped_scene_has_a_row() -> None:
    line = shipped.row("static_5kN")
    assert line.startswith("| `static_5kN`")
    assert line.endswith("|")


def test_a_row_of_torques_has_what_is_off_over_the_estimate_of_the_pockets() -> None:
    line = torque.row("smooth_run", "modes", torque.Found(6.0, 0.005, 0.02, 0.36, 0.2, 6.1, 5.7))
    assert line == "| `smooth_run` | modes | 6.00 | 0.5 | 2.0 | 6.0 | 3.3 | +1.7 (0.50) | -5.0 (1.50) |"


def test_the_choice_expects_what_the_table_of_torques_has() -> None:
    """But where rollers slip: there other rules bound the torque."""
    text = torque.PAGE.read_text(encoding="utf-8")
    section = text[text.index(torque.TITLE) : text.index(bands.TITLE)]
    rows = [line.strip("| ").split(" | ") for line in section.splitlines() if line.startswith("| `")]
    assert {name.strip("`") for name, *_ in rows} == set(torque.SCENES)
    for name, box, *cells in rows:
        if name == "`static_5kN`":
            continue
        for tier, cell in zip(("quasistatic", "lumped"), cells[-2:], strict=True):
            over = float(cell.split("(")[1].rstrip(")"))
            assert over <= discretisation_error.POCKETS[tier], (name, box, tier)


def test_the_worst_band_of_each_range_stands_with_its_frequency() -> None:
    apart = np.zeros(len(NOMINAL_BANDS))
    for band, decibels in ((100, -0.4), (400, 0.2), (630, 1.0), (800, -2.0), (5000, 3.0), (6300, 9.0)):
        apart[NOMINAL_BANDS.index(band)] = decibels
    assert bands.worst(apart) == ["-0.4 at 100", "+0.2 at 400", "-2.0 at 800", "+3.0 at 5000", "+9.0 at 6300"]


def test_the_choice_expects_what_the_table_of_third_octaves_has() -> None:
    text = bands.PAGE.read_text(encoding="utf-8")
    section = text[text.index(bands.TITLE) : text.index(bands.NEXT)]
    rows = [line.strip("| ").split(" | ") for line in section.splitlines() if line.startswith("| `")]
    undamped = [cells for cells in rows if cells[1] == bands.UNDAMPED]
    assert len(undamped) == len(bands.SCENES)
    for name, _, *cells in undamped:
        found = [abs(float(cell.split()[0])) for cell in cells[:3]]
        assert max(found[:2]) <= friction.UNDAMPED_QUIET_DB, name
        assert found[2] <= friction.UNDAMPED_DB, name
    rows = [cells for cells in rows if cells[1] != bands.UNDAMPED]
    assert len(rows) == len(bands.SCENES) * (len(bands.TIERS) + 1)
    middle_of = {f"`{tier}`": error for tier, error in discretisation_error.IN_MIDDLE_BAND.items()}
    beyond_of = {f"`{tier}`": error for tier, error in discretisation_error.BEYOND.items()}
    middle_of[bands.COUPLED] = discretisation_error.COUPLED_IN_MIDDLE_BAND
    beyond_of[bands.COUPLED] = discretisation_error.COUPLED_BEYOND
    for name, tier, *cells in rows:
        low, quiet, middle, high, beyond = (abs(float(cell.split()[0])) for cell in cells)
        assert max(low, quiet, middle) <= discretisation_error.IN_LOW_BAND, name
        assert high <= middle_of[tier], name
        assert beyond <= beyond_of[tier], name
        if not load_scene(name.strip("`"), effects="standard").faults:
            assert max(low, quiet) <= discretisation_error.IN_QUIET_BAND, name


@pytest.mark.slow
def test_where_one_spring_a_roller_misses_the_deflection_the_bound_of_lumped_is_wider() -> None:
    chosen = load_scene("oversize_roller", tier="lumped", effects="auto", vibration_to=1e3)
    apart = bands.levels(chosen) - bands.levels(load_scene("oversize_roller", tier="full", effects="auto"))
    to_1_kHz = [abs(float(each)) for each, band in zip(apart, NOMINAL_BANDS, strict=True) if band <= 1e3]
    expected = explain_scene(
        "oversize_roller", tier="lumped", effects="auto", vibration_to=1e3
    ).current.expected
    assert max(to_1_kHz) > discretisation_error.IN_LOW_BAND  # so that the wider one is needed
    assert max(to_1_kHz) < expected["vibration"]


def test_a_roller_of_another_size_widens_the_bound_of_lumped() -> None:
    chosen = explain_scene("oversize_roller", tier="lumped", effects="auto", vibration_to=1e3)
    assert "where springs fit; here they may be off by 22 dB" in chosen.current.tier_reason
