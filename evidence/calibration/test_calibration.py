"""Tables tell truth beside fit, what was missed and what was left; the page has their place."""

from __future__ import annotations

from typing import Any

from beardyn_core.calibration.unknowns import UNKNOWNS
from evidence.calibration.hidden import BOXES, Hidden
from evidence.calibration.page import BEGIN, END, PAGE, table, with_table


def result(box: Hidden, missed: str, left: str) -> dict[str, Any]:
    """Make what a calibration came to: every number within a tenth, but for one."""
    unknowns = []
    for each in UNKNOWNS:
        value = getattr(box, each.name) * (2.0 if each.name == missed else 1.0)
        unknowns.append(
            {
                "name": each.name,
                "base": 1.0,
                "value": value,
                "interval_90": [0.9 * value, 1.1 * value],
                "share_of_range": 0.2,
                "reason": "not determined" if each.name == left else "",
            }
        )
    return {"unknowns": unknowns, "residual_before_dB": 6.0, "residual_after_dB": 2.0, "twins": 48}


def test_a_miss_is_told_and_what_is_left_counts_for_nothing() -> None:
    told = table({BOXES[0]: result(BOXES[0], "damping", "noise")})
    assert [line.split("|")[2].strip() for line in told.splitlines() if "missed" in line] == [
        "damping of the box, factor"
    ]
    assert "left at 1 |" in told
    assert "Of 4 intervals of 90 % of fitted numbers 3 hold the truth; 1 of all numbers" in told


def test_every_box_is_unlike_the_scene_in_every_number() -> None:
    usual = {"frequency": 1.0, "damping": 1.0, "background": 1.0, "noise": 2.9e-4, "end_play": 0.1}
    for box in BOXES:
        assert all(getattr(box, name) != value for name, value in usual.items())


def test_the_page_has_a_place_for_the_tables() -> None:
    page = with_table(PAGE.read_text(encoding="utf-8"), "nothing but this\n")
    assert f"{BEGIN}\nnothing but this\n\n{END}" in page
