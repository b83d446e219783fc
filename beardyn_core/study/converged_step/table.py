"""The study as tables for the terminal and the page."""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.study.table import Table

_CRITERIA = {
    "mean": "torque mean",
    "scatter": "torque scatter",
    "bands": "third octaves",
    "lines": "spectrum",
}


def point_table(point: dict[str, Any]) -> Table:
    """All time steps of one load against the reference."""
    chosen = {choice["steps_per_sample"]: name for name, choice in reversed(point["chosen"].items())}
    rows = [_row(row, chosen) for row in point["rows"]]
    reference = point["reference"]
    head = (
        "step", "steps a sample", "s/s", "torque N m", "mean %", "", "scatter N m", "scatter %", "",
        "scatter 25.6 kHz %", "chatter", "third octaves dB", "", "lines dB", "",
    )  # fmt: skip
    said = (
        f"reference {reference['name']}, {reference['runs']} runs: torque {reference['torque_Nm']:.4f} "
        f"(known to {100.0 * reference['torque_doubt']:.2f} %) +- {reference['scatter_Nm']:.3f} N m, behind "
        f"the filter {reference['heard_scatter_Nm']:.3f} N m, chatter {reference['chatter']:.3f}, "
        f"{reference['wall']:.3g} s a simulated second"
    )
    title = f"{point['name']}, {point['speed_rad_s']:g} rad/s"
    return Table(title, head, tuple(rows), (said, *(verdict_text(point, name) for name in point["chosen"])))


def verdict_text(point: dict[str, Any], asked: str) -> str:
    """What is chosen and how it does."""
    choice = point["chosen"][asked]
    each = ", ".join(f"{_CRITERIA[key]} {verdict}" for key, verdict in choice["verdicts"].items())
    return f"chosen for {asked}: {choice['steps_per_sample']} steps a sample ({choice['reason']}): {each}"


def _row(row: dict[str, Any], chosen: dict[int, str]) -> tuple[str, ...]:
    name = row["name"]
    if row["integrator"] == "implicit" and row["steps"] in chosen:
        name += f", chosen for {chosen[row['steps']]}"
    if "ended" in row:
        return (name, str(row["steps"]), *(13 * ("-",)))
    return (
        name,
        str(row["steps"]),
        f"{row['wall']:.2g}",
        f"{row['torque_Nm']:.3f}",
        _percent(row["mean"]),
        row["mean"]["verdict"],
        f"{row['scatter_Nm']:.2f}",
        _percent(row["scatter"]),
        row["scatter"]["verdict"],
        _percent(row["heard_scatter"]),
        f"{row['chatter']:.3f}",
        _decibels(row["bands"]),
        row["bands"]["verdict"],
        _decibels(row["lines"]),
        row["lines"]["verdict"],
    )


def _percent(found: dict[str, Any]) -> str:
    return f"{100.0 * found['difference']:+.2f} +- {100.0 * found['doubt']:.2f}"


def _decibels(found: dict[str, Any]) -> str:
    """The largest difference of all bands."""
    values = np.array(found["difference_dB"])
    worst = int(np.abs(values).argmax())
    return f"{values[worst]:+.1f} +- {found['doubt_dB'][worst]:.1f}"
