"""The study as tables for the terminal and the page."""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.study.table import Table

CRITERIA = {
    "mean": "torque mean",
    "pooled_mean": "torque mean, pooled",
    "scatter": "torque scatter",
    "bands": "third octaves in the band",
    "bands_limit": "third octaves within 1.5 dB",
    "lines": "50 Hz lines in the band",
}
_MANY_TIMES = 3.0


def point_tables(point: dict[str, Any], data: dict[str, Any]) -> tuple[Table, Table]:
    """Make the tables of torque and spectra of all time steps of one load against the reference."""
    return _torque(point), _spectra(point, data)


def verdict_text(point: dict[str, Any], asked: str) -> str:
    """Say what is chosen and how it does."""
    choice = point["chosen"][asked]
    each = ", ".join(f"{CRITERIA[key]} {verdict}" for key, verdict in choice["verdicts"].items())
    return f"chosen for {asked}: {choice['steps_per_sample']} steps a sample ({choice['reason']}): {each}"


def unstable_table(data: dict[str, Any]) -> Table:
    """Make the table of explicit steps across their limit."""
    head = (
        "effects, load, step", "first 5 ms N m", "mean N m", "scatter N m", "every second step N m",
        "chatter",
    )  # fmt: skip
    rows = []
    for row in data["unstable"]:
        numbers = [row[key] for key in ("mean", "scatter", "scatter_every_second", "chatter")]
        cells = (
            ("ended", *(4 * ("",)))
            if row["ended"]
            else (f"{row['begun']:.4f}", *(f"{value:.3f}" for value in numbers))
        )
        rows.append((f"{row['effects']}, {row['load']}, {row['method']}", *cells))
    return Table("Torque over 20 ms, 20 ms after equilibrium", head, tuple(rows))


def _torque(point: dict[str, Any]) -> Table:
    head = (
        "step", "steps a sample", "s/s", "% in 5 ms", "mean N m", "% of reference", "", "% of pooled", "",
        "scatter N m", "%", "", "% at 25.6 kHz", "chatter",
    )  # fmt: skip
    rows = []
    for row in point["rows"]:
        cells = (
            (
                f"{row['wall']:.2g}",
                f"{100.0 * row['begun']:+.2f}",
                f"{row['torque_Nm']:.3f}",
                *_percent(row["mean"]),
                *_percent(row["pooled_mean"]),
                f"{row['scatter_Nm']:.2f}",
                *_percent(row["scatter"]),
                _percent(row["filtered_scatter"])[0],
                f"{row['chatter']:.3f}",
            )
            if "ended" not in row
            else ("ended", *(11 * ("",)))
        )
        rows.append((_name(row, point), str(row["steps"]), *cells))
    reference = point["reference"]
    said = (
        f"Reference {reference['name']}, {reference['runs']} runs: torque {reference['torque_Nm']:.4f} N m, "
        f"known to {100.0 * reference['torque_doubt']:.2f} %; scatter {reference['scatter_Nm']:.3f} N m, "
        f"{reference['filtered_scatter_Nm']:.3f} behind the filter; chatter {reference['chatter']:.4f}; "
        f"{reference['wall']:.3g} s a simulated second. Pooled with 0.5 us, {reference['pooled_runs']} runs: "
        f"{reference['pooled_torque_Nm']:.4f} N m."
    )
    title = f"{point['name']}, {point['speed_rad_s']:g} rad/s: torque"
    return Table(title, head, tuple(rows), (said,))


def _spectra(point: dict[str, Any], data: dict[str, Any]) -> Table:
    head = (
        "step", "third octaves, rms dB", "worst", "in the band", "within 1.5 dB", "lines, rms dB", "worst",
        "in the band",
    )  # fmt: skip
    reference, rows = point["reference"], []
    for row in point["rows"]:
        cells = (
            (
                f"{row['bands']['rms_dB']:.2f}",
                _worst(row["bands"], reference["bands_band_dB"], data["bands_Hz"]),
                row["bands"]["verdict"],
                row["bands_limit"]["verdict"],
                f"{row['lines']['rms_dB']:.2f}",
                _worst(row["lines"], reference["lines_band_dB"], data["lines_Hz"]),
                row["lines"]["verdict"],
            )
            if "ended" not in row
            else (7 * ("",))
        )
        rows.append((_name(row, point), *cells))
    title = f"{point['name']}, {point['speed_rad_s']:g} rad/s: housing acceleration to 10 kHz"
    return Table(title, head, tuple(rows))


def _name(row: dict[str, Any], point: dict[str, Any]) -> str:
    asked = [name for name, choice in point["chosen"].items() if choice["steps_per_sample"] == row["steps"]]
    return f"{row['name']}, for {asked[0]}" if row["integrator"] == "implicit" and asked else str(row["name"])


def _percent(found: dict[str, Any]) -> tuple[str, str]:
    change = found["difference"]
    if change > _MANY_TIMES:
        return f"x {1.0 + change:.0f}", str(found["verdict"])
    return f"{100.0 * change:+.2f} +- {100.0 * found['doubt']:.2f}", str(found["verdict"])


def _worst(found: dict[str, Any], band: list[float], frequencies: list[float]) -> str:
    """Find the difference that fills most of the run-to-run band."""
    values, width = np.array(found["difference_dB"]), np.array(band)
    worst = int(np.argmax(np.abs(values) / width))
    return f"{values[worst]:+.1f} of {width[worst]:.1f} at {1e-3 * frequencies[worst]:.3g} kHz"
