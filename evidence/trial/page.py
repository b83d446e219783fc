"""Write docs/evidence/trial.md from trial.json files: ``python -m evidence.trial.page FOLDER [FOLDER ...]``.

Folders are those of ``beardyn trial -o FOLDER``. That of `default` makes the page and its picture; of others
there are sections in it, which stay as they were when their folders are not given. docs/monitor.md gets the
settings of the shipped monitor.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from beardyn_core.monitor.chain import MonitorSettings
from evidence.pages import DOCS, PICTURES, REPORTS, render, save_small
from evidence.trial import growth_picture
from evidence.trial.rivals import EVERY, Judged, orders, table

HERE = Path(__file__).parent
PAGE, MONITOR_PAGE = REPORTS / "trial.md", DOCS / "monitor.md"
PICTURE = PICTURES / "trial.png"
COLOURS = 64
DEFAULT, GROWTH = "default", "growth"
NEXT = "## Limits\n"
# of another trial, or of other monitors
_SECTION = re.compile(r"^## (?:`\w+`|Compared with other monitors)\n(?:(?!## ).*\n)*", re.MULTILINE)


def main() -> None:
    """Write the page, or with folders of other trials than `default` their sections alone."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="+", help="of `beardyn trial -o`, that of `default` first")
    parser.add_argument(
        "--rivals", type=Path, help="of `python -m evidence.trial.rivals -o`; default as it was"
    )
    args = parser.parse_args()
    folders = args.folder
    found = [json.loads((each / "trial.json").read_text(encoding="utf-8")) for each in folders]
    rivals = [] if args.rivals is None else json.loads(args.rivals.read_text(encoding="utf-8"))
    compared = beside_others([Judged(**each) for each in rivals])
    text = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    if found[0]["trial"] == DEFAULT:
        text = with_old_sections(page(found[0]), text)
        save_small(folders[0] / "trial.png", PICTURE, COLOURS)
    others = [each for each in found if each["trial"] != DEFAULT]
    for each in others:
        if each["trial"] == GROWTH:
            growth_picture.draw(each)
    for section in (compared, *map(other_trial, others)):
        text = with_section_of(text, section)
    PAGE.write_text(text, encoding="utf-8")
    MONITOR_PAGE.write_text(monitor_page(), encoding="utf-8")


def with_old_sections(page: str, old: str) -> str:
    """Take over what another page has of other trials and monitors."""
    for section in _SECTION.findall(old):
        page = with_section_of(page, section)
    return page


def with_section_of(page: str, section: str) -> str:
    """Put a section in the place of that of its title, or behind those of the other trials."""
    written = section.strip()
    if not written:
        return page
    title = written.partition("\n")[0] + "\n"
    start = page.find(title)
    begin = page.index(NEXT) if start < 0 else start
    end = begin if start < 0 else page.index("\n## ", start) + 1
    return page[:begin] + written + "\n\n" + page[end:]


def page(found: dict[str, Any]) -> str:
    """Write the page of a trial's JSON object."""
    values = {
        **_results(found),
        "revolutions": found["revolutions"],
        "seed": found["seed"],
        "check": _check(found["check"], found["check_tier"]),
    }
    return render(__file__, values)


def monitor_page() -> str:
    """Write the page of the monitor with its settings."""
    settings = MonitorSettings()
    values = {
        "rate": settings.false_alarm_rate,
        "harmonics": settings.strike_harmonics,
        "whole": settings.least_strikes,
        "cup": settings.least_sharpest[0],
        "others": settings.least_sharpest[1],
        "faint": settings.faint_margin,
        "rival": settings.faint_rival,
        "faint_octave": settings.faint_sharpest[0],
        "faint_modulated": settings.faint_sharpest[1],
        "clockwork": settings.clockwork_depth,
        "deep": settings.clockwork_strikes,
        "hot": settings.hot - 273.15,
        "heating": 60.0 * settings.heating,
        "floor": settings.heating_floor - 273.15,
    }
    return render(HERE / "monitor.md", values)


def _results(found: dict[str, Any]) -> dict[str, Any]:
    """Give the numbers of a trial that every section has."""
    first = found["invalid"][0] if found["invalid"] else {"run": "", "status": ""}
    return {
        **{name: found[name] for name in ("trial", "purpose", "run_count", "tier")},
        "sizes": [_size_row(row) for row in found["sizes"]],
        "surfaces": [each["surface"] for each in found["sizes"][0]["surfaces"]] if found["sizes"] else [],
        "on_surfaces": [_surface_row(row) for row in found["sizes"]],
        "smallest": [_smallest(row) for row in found["smallest"]],
        "slices": [(row["name"], _rate(row["found"]), _rate(row["false_alarms"])) for row in found["slices"]],
        "analyses": _analyses(found),
        "invalid": len(found["invalid"]),
        "first_invalid": f"{first['run']}: {first['status']}",
    }


def other_trial(found: dict[str, Any]) -> str:
    """Write the section of another trial."""
    picture = f"../pictures/{growth_picture.PICTURE.name}" if found["trial"] == GROWTH else ""
    return render(HERE / "other_trial.md", {**_results(found), "picture": picture})


def beside_others(judged: Sequence[Judged]) -> str:
    """Write what other monitors make of the same runs."""
    values = {"every": EVERY, "table": table(judged), "orders": orders(judged)}
    return render(HERE / "rivals.md", values) if judged else ""


def _rate(rate: dict[str, Any]) -> str:
    if not rate["total"]:
        return "-"
    return (
        f"{rate['count']}/{rate['total']}, {100 * rate['rate']:.3g} % "
        f"({100 * rate['low']:.2g} to {100 * rate['high']:.3g})"
    )


def _size_row(row: dict[str, Any]) -> tuple[str, ...]:
    low, middle, high = row["score_dB"].values()
    score = "-" if middle is None else f"{middle:.1f} ({low:.1f} to {high:.1f})"
    return row["fault"], f"{1e3 * row['width_m']:g}", _rate(row["found"]), str(row["wrong"]), score


def _surface_row(row: dict[str, Any]) -> tuple[str, ...]:
    rates = (each["found"] for each in row["surfaces"])
    return row["fault"], f"{1e3 * row['width_m']:g}", *(f"{each['count']}/{each['total']}" for each in rates)


def _smallest(row: dict[str, Any]) -> str:
    if row["width_m"] is None:
        return f"{row['fault']}: none of these sizes"
    high = "beyond the largest" if row["high_m"] is None else f"{1e3 * row['high_m']:g} mm"
    low = 1e3 * (row["width_m"] if row["low_m"] is None else row["low_m"])
    return f"{row['fault']}: {1e3 * row['width_m']:g} mm ({low:g} mm to {high})"


def _analyses(found: dict[str, Any]) -> str:
    analyses = found["false_analyses"]
    said = f"Analyses of healthy runs with an alarm: {_rate(analyses)}."
    if found["monitor"]:
        return said
    rate = found["stated_false_alarm_rate"]
    allowed = f"{100 * rate:g} %: {rate * analyses['total']:.2g} of them"
    return f"{said} In stationary noise the threshold allows {allowed}."


def _check(check: dict[str, Any] | None, tier: str) -> dict[str, Any] | None:
    if check is None:
        return None
    low, middle, high = check["score_difference_dB"].values()
    return {
        "tier": tier,
        "agreement": _rate(check["agreement"]),
        "false_alarms": _rate(check["false_alarms"]),
        "low": low,
        "middle": middle,
        "high": high,
        "different": check["different"],
    }


if __name__ == "__main__":
    main()
