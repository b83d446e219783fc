"""The pages of the automatic choices say what was chosen and how it turned out."""

from __future__ import annotations

from evidence.automatic import shipped, torque
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
        "longer": 1,
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


def test_a_row_of_torques_has_what_is_off_over_the_estimate_of_the_pockets() -> None:
    line = torque.row("smooth_run", torque.Found(6.0, 0.005, 0.02, 0.36, 0.2, 6.1, 5.7))
    assert line == "| `smooth_run` | 6.00 | 0.5 | 2.0 | 6.0 | 3.3 | +1.7 (0.50) | -5.0 (1.50) |"
