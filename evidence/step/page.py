"""Write docs/evidence/step.md and its picture from the numbers of `make step`.

``python -m evidence.step.page step.json``
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from evidence.pages import PICTURES, REPORTS, render, save_small
from evidence.runner import read_json
from evidence.step.cases import BRIDGE, REFERENCE
from evidence.step.picture import step_picture
from evidence.step.table import CRITERIA, point_tables, unstable_table
from evidence.tables import markdown

PAGE = REPORTS / "step.md"
PICTURE = PICTURES / "step.png"
COLOURS = 32

SHORT_S = 1.0


def main() -> None:
    """Read and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("numbers", type=Path, metavar="JSON")
    data = read_json(parser.parse_args().numbers)
    PAGE.write_text(page(data), encoding="utf-8")
    step_picture(data, PICTURE)
    save_small(PICTURE, PICTURE, COLOURS)


def page(data: dict[str, Any]) -> str:
    """Put the whole page together."""
    points, extent, limits = data["points"], data["extent"], data["limits"]
    values = {
        "loads": " and ".join(f"{point['name']}, {point['speed_rad_s']:g} rad/s" for point in points),
        "effects": data["effects"],
        "laminae": data["laminae"],
        "mean": 100.0 * limits["mean"],
        "scatter": 100.0 * limits["scatter"],
        "chatter": limits["chatter"],
        "verdicts": verdicts(points),
        "short": extent["duration"] < SHORT_S,
        "steps": REFERENCE.steps,
        "wall": points[0]["reference"]["wall"],
        "unstable": unstable_table(data),
        "gap": gap(points),
        "points": [table for point in points for table in point_tables(point, data)],
        **{key: extent[key] for key in ("duration", "settling", "reference_runs", "runs")},
    }
    return render(__file__, values)


def gap(points: list[dict[str, Any]]) -> str:
    """Say by how much the pooled explicit steps differ at most while runs follow one another."""
    rows = (row for point in points for row in point["rows"] if row["name"] == BRIDGE.name)
    return f"{100.0 * max(abs(row['begun']) for row in rows):.1g} %"


def verdicts(points: list[dict[str, Any]]) -> str:
    """List what is chosen at each load, and every criterion."""
    found = [(point["name"], asked, choice) for point in points for asked, choice in point["chosen"].items()]
    names = [f"{load}, {asked}: {choice['steps_per_sample']} steps a sample" for load, asked, choice in found]
    rows = [
        (criterion, *(choice["verdicts"].get(key, "") for _, _, choice in found))
        for key, criterion in CRITERIA.items()
    ]
    return markdown(("chosen for", *names), rows)


if __name__ == "__main__":
    main()
