"""The page of changing speeds shows every answer, and counts what is named right and what alarms."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from evidence.service.variable_speed import PROFILES, STEADY, WAYS, WIDTHS, WORN, _reason, text


def rows() -> list[list[Any]]:
    found: list[list[Any]] = []
    parts = ("", *WIDTHS)
    for profile in PROFILES:
        for part in parts:
            verdicts = {"tachometer": part or "healthy", "vibration": "refused", "stated": "healthy"}
            for way in WAYS:
                sure = None if verdicts[way] == "refused" else 0.75
                found.append([profile, part, way, verdicts[way], 4, 5, sure, "why"])
    worn = [[WORN, part, "stated", "unexplained" if part else "cup", 3, 3, None, ""] for part in parts]
    return [*found, *worn]


def test_the_page_counts_what_is_named_right_and_what_alarms() -> None:
    page = text(rows())
    assert f"| tachometer | {3 * len(PROFILES)} of {3 * len(PROFILES)} |" in page
    assert f"| from the vibration | 0 of {3 * len(PROFILES)} |" in page
    assert "Healthy runs with an alarm: 1 of" in page
    assert f"| {STEADY} | tachometer | healthy 4/5, 0.75 | cup 4/5, 0.75 |" in page
    assert "unexplained 3/3 |" in page
    assert page.count("- steady: why") == 1


def test_a_reason_has_neither_file_nor_options() -> None:
    path = Path("folder") / "b.wav"
    sentence = f"{path}: the speed is not known, and from 0 s on it fits two; give one of --speed-rpm"
    assert _reason(sentence, path) == "it fits two"
    assert _reason("no file", path) == "no file"
