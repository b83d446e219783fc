"""The pages of the automatic choices say what was chosen and how it turned out."""

from __future__ import annotations

from evidence.automatic import shipped
from evidence.automatic.page import row


def test_a_row_shows_what_was_found_beside_what_was_expected() -> None:
    case = {
        "scene": "static_80kN",
        "asked": ["torque"],
        "accuracy": 0.05,
        "tier": "full",
        "laminae": 6,
        "steps_per_sample": 4,
        "effects": ["film", "rib"],
        "missing": ["drag"],
        "found": {"torque": "1.2 %"},
        "expected": {"torque": "2"},
        "status": "complete",
        "verdict": "yes",
    }
    assert row(case) == (
        "| `static_80kN` | torque at 5 % | full, 6 laminae x 4: full less drag | torque 1.2 % (*2*) | yes |"
    )
    assert "; it stopped |" in row({**case, "status": "it stopped"}).replace(
        "it stopped | yes", "it stopped |"
    )


def test_a_shipped_scene_has_a_row() -> None:
    line = shipped.row("static_5kN")
    assert line.startswith("| `static_5kN`")
    assert line.endswith("|")
