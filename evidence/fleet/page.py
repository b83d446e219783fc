"""Write docs/evidence/fleet_year.md from `evidence.fleet.year`: ``python -m evidence.fleet.page``."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from evidence.fleet import year
from evidence.fleet.signals import HEALTHY, RECORDED, WIDTHS_MM
from evidence.pages import REPORTS, render
from evidence.tables import markdown

PAGE = REPORTS / "fleet_year.md"
_HEAD = ("axlebox", "spall", "2 mm on day", "20 mm on day", "watch", "plan", "act", "lead of plan", "rank")


def page(found: Mapping[str, Any]) -> str:
    """Write the page of a judged year."""
    spalls = found["spalls"]
    rows = [
        (
            each["box"],
            each["part"],
            str(each["begins"]),
            str(each["ends"]),
            *(_first(each, state) for state in ("watch", "plan", "act")),
            "never" if each["lead_days"] is None else f"{each['lead_days']:.0f} days",
            str(each["rank"]),
        )
        for each in spalls
    ]
    left = [
        (each["box"], "-", each["left"], "-", "-")
        if each["left_on_day"] is None
        else (
            *(each["box"], f"{each['left_on_day']:.0f}", each["left"], each["laws"]),
            f"{each['true_left_km']:,.0f} km",
        )
        for each in spalls
    ]
    others = [(str(each["rank"]), each["box"], each["health"], each["why"]) for each in found["listed"]]
    leads = [each["lead_days"] for each in spalls if each["lead_days"] is not None]
    values = {
        "recordings": found["recordings"],
        "every": found["every_days"],
        "widths": f"{WIDTHS_MM[0]:g} to {WIDTHS_MM[-1]:g}",
        "runs": HEALTHY + 2 * len(WIDTHS_MM) + 1,
        "seconds": RECORDED,
        "spalls": markdown(_HEAD, rows, "llrrlllrr"),
        "left": markdown(("axlebox", "day", "first statement", "over the laws", "true"), left, "lrllr"),
        "listed": markdown(("rank", "axlebox", "health", "why"), others, "rlll"),
        "found": len(leads),
        "count": len(spalls),
        "shortest": f"{min(leads):.0f}" if leads else "no",
        "false_alarms": found["false_alarms"],
        "watch_percent": 100.0 * found["watch_share"],
        "watched": ", ".join(found["boxes_watched"]) or "none",
        "dead": year.DEAD.name,
        "dead_from": year.DEAD_FROM,
        "dead_health": found["dead"].replace("_", " "),
        "flat": " axle ".join(year.FLAT_AXLE),
        "flat_from": year.FLAT_FROM,
        "flat_to": year.FLAT_TO,
        "turned": year.TURNED,
        "turned_on": year.TURNED_ON,
    }
    return render(__file__, values)


def _first(spall: Mapping[str, Any], state: str) -> str:
    """Write the day on which a state began, and the width of the spall then."""
    day, width = spall["first"][state], spall["width_mm"][state]
    return "never" if day is None else f"day {day:.0f}, {width:.1f} mm"


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(json.loads(year.KEPT.read_text(encoding="utf-8"))), encoding="utf-8")


if __name__ == "__main__":
    main()
