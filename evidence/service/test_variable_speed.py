"""The page of changing speeds shows every answer, and counts what is named right and what alarms."""

from __future__ import annotations

from pathlib import Path

from evidence.service.variable_speed import PROFILES, STEADY, WAYS, WIDTHS, WORN, _reason, text


def rows() -> list[list[object]]:
    found: list[list[object]] = []
    for profile in PROFILES:
        for part in ("", *WIDTHS):
            for way in WAYS:
                verdict = (
                    (part or "healthy")
                    if way == "tachometer"
                    else "refused"
                    if way == "vibration"
                    else "healthy"
                )
                found.append(
                    [profile, part, way, verdict, 4, 5, 0.75 if verdict != "refused" else None, "why"]
                )
    found += [
        [WORN, part, "stated", "unexplained" if part else "cup", 3, 3, None, ""] for part in ("", *WIDTHS)
    ]
    return found


def test_the_page_counts_what_is_named_right_and_what_alarms() -> None:
    page = text(rows())
    assert f"| tachometer | {3 * len(PROFILES)} of {3 * len(PROFILES)} |" in page
    assert f"| from the vibration | 0 of {3 * len(PROFILES)} |" in page
    assert "Healthy runs with an alarm: 1 of" in page
    assert f"| {STEADY} | tachometer | healthy 4/5, 0.75 | cup 4/5, 0.75 |" in page
    assert "unexplained 3/3 |" in page
    assert page.count("- steady: why") == 1


def test_a_reason_has_neither_file_nor_options() -> None:
    path = Path("/tmp/a/b.wav")
    sentence = f"{path}: the speed is not known, and from 0 s on it fits two; give one of --speed-rpm"
    assert _reason(sentence, path) == "it fits two"
    assert _reason("no file", path) == "no file"
