"""A ladder as a table and as JSON."""

from __future__ import annotations

import math
import os
import platform
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.study.ladder_levels import AUTO, OF_THE_SCENE, Level
from beardyn_core.study.ladder_result import BAND_LIMIT_DB, Ladder, LevelResult, QuantityError
from beardyn_core.study.measures import MEASURES, QUANTITIES, UNITS

_BAND_ROW = "reference, and the band of a single run"
_LEGEND = (
    "6 laminae x 4: 4 steps for each sample of 25.6 kHz; a level without a tier is of the full tier",
    "wall: wall time per simulated second, median over blocks; RTF: its inverse",
    "errors: the worst component of each quantity, in % or dB; (in brackets): not resolved, within the "
    "run-to-run band",
    "*: efficient, no cheaper level is as good; yes: good enough with 95 % certainty; no: not so, with the "
    "whole band; open: the runs are too short to tell",
)


def percent(share: float) -> str:
    """Write a share in percent without needless digits."""
    return f"{100.0 * share:g} %"


def error_text(error: QuantityError | None) -> str:
    """Write the worst error of a quantity, in % or dB; in brackets when it is not resolved."""
    if error is None or error.worst is None:
        return "-"
    text = amount(abs(error.worst.error), error.unit)
    return text if error.worst.resolved else f"({text})"


def amount(value: float, unit: str) -> str:
    """Write two digits of a share in percent, or of dB."""
    shown = 100.0 * value if unit == "%" else value
    if not math.isfinite(shown):
        return "?"
    return f"{shown:.0f}" if shown >= 9.95 else f"{shown:.1f}" if shown >= 0.95 else f"{shown:.2f}"


def _band_text(error: QuantityError | None) -> str:
    bands = [part.band for part in error.parts] if error is not None else []
    return f"±{amount(max(bands), error.unit)}" if error is not None and bands else "-"


def heading(ladder: Ladder) -> list[str]:
    """Say what is compared with what."""
    count, windows = ladder.revolutions, len(ladder.edges) - 1
    turns = count_words(count, "whole cage revolution") if count else "no whole cage revolution"
    reference = ladder.reference
    return [
        f"{ladder.scene}: {ladder.purpose}",
        f"compared over {ladder.edges[-1] - ladder.edges[0]:.2f} s, {turns}, in "
        f"{count_words(windows, 'window')} from {ladder.edges[0]:.2f} s on",
        f"reference: {_describe_result(reference)}, {reference.runs} runs, {reference.cost.median:.1f} s for "
        "each simulated second",
        f"accuracy {percent(ladder.accuracy)}: {'; '.join(limits_of(ladder))}",
    ]


def count_words(number: int, what: str) -> str:
    """Write a count with its word, in singular or plural."""
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def limits_of(ladder: Ladder) -> list[str]:
    """List the quantities and the limits of their errors."""
    words = {"%": percent(ladder.accuracy), "dB": f"{BAND_LIMIT_DB:g} dB"}
    asked = {unit: [name for name in ladder.asked if UNITS[name] == unit] for unit in words}
    return [f"{', '.join(names)} within {words[unit]}" for unit, names in asked.items() if names]


def _describe_result(result: LevelResult) -> str:
    level = result.level
    micro = 1e6 / (WAVEFORM_RATE * level.steps_per_sample)
    return f"{level.tier}, effects {level.effects_name}, {level.laminae} laminae, step {micro:.1f} µs"


def convergence(ladder: Ladder) -> str:
    """Say how far the reference is converged; empty when its neighbour was not run."""
    if ladder.neighbour is None:
        return ""
    name, errors = ladder.neighbour.level.name, ladder.neighbour.errors
    differences = [f"{e.quantity} {error_text(e)} {e.unit}" for e in errors if e.worst is not None]
    sentence = f"the reference with half of its laminae and twice its step ({name}): {', '.join(differences)}"
    if ladder.unconverged:
        sentence += f"; not converged within {percent(ladder.accuracy)}: {', '.join(ladder.unconverged)}"
    return sentence


def closing(ladder: Ladder) -> list[str]:
    """Write the conclusion below the table."""
    best, rows = ladder.cheapest, (ladder.reference, *ladder.rows)
    undecided = [row.level.name for row in ladder.rows if ladder.verdict(row) == "open"]
    found = "none" + (f"; open: {'; '.join(undecided)}" if undecided else "")
    if best is not None:
        found = f"{best.level.name}, {best.cost.median:.2f} s for each simulated second"
    return [
        f"cheapest level within {percent(ladder.accuracy)}: {found}",
        *choices(ladder),
        *(f"{row.level.name}: {row.status}" for row in rows if row.status != "complete"),
        *(["interrupted: some levels are missing"] if ladder.interrupted else []),
    ]


def choices(ladder: Ladder) -> list[str]:
    """Explain the levels whose names do not say what they are computed with."""
    return [
        f"{row.level.name}: {row.level.tier} tier, "
        f"{row.level.laminae} laminae x {row.level.steps_per_sample}, "
        f"effects: {_effects_text(ladder, row.level)}"
        for row in ladder.rows
        if row.level.effects_name in (AUTO, OF_THE_SCENE)
    ]


def _effects_text(ladder: Ladder, level: Level) -> str:
    """Name the effects, or their differences from those of the reference."""
    held, absent, other = _against_reference(ladder, level)
    text = "all" + (f" less {', '.join(absent)}" if absent else "")
    if len(absent) > len(held):
        text = ", ".join(held)
    return text + (f"; with other parameters than in the reference: {', '.join(other)}" if other else "")


def _against_reference(ladder: Ladder, level: Level) -> tuple[list[str], list[str], list[str]]:
    """List the effects that a level has, lacks against the reference, and has with other parameters."""
    every, held = ladder.reference.level.effects, list(level.effects.names())
    absent = [name for name in every.names() if name not in held]
    other = [name for name in held if getattr(level.effects, name) != getattr(every, name)]
    return held, absent, other


def table(ladder: Ladder) -> str:
    """Write a readable table with heading and legend."""
    names = [f"{quantity} {UNITS[quantity]}" for quantity in QUANTITIES]
    widths = [len(name) + 2 for name in names]
    efficient = {row.level.name for row in ladder.efficient}
    wide = 2 + max(len(name) for name in (_BAND_ROW, *(row.level.name for row in ladder.rows)))
    head = f"{'level':{wide}}{'wall':>8}{'RTF':>8}"
    head += (
        "".join(f"{name:>{width}}" for name, width in zip(names, widths, strict=True))
        + f"{percent(ladder.accuracy):>7}"
    )

    def line(row: LevelResult, name: str, texts: Sequence[str], verdict: str) -> str:
        wall = row.cost.median
        cells = "".join(f"{text:>{width}}" for text, width in zip(texts, widths, strict=True))
        return f"{name:{wide}}{wall:>8.3f}{1.0 / wall:>8.2f}{cells}{verdict:>7}"

    lines = [*heading(ladder), "", head]
    for row in ladder.by_cost:
        mark = "* " if row.level.name in efficient else "  "
        texts = [error_text(row.of(quantity)) for quantity in QUANTITIES]
        lines.append(line(row, mark + row.level.name, texts, ladder.verdict(row)))
    bands = [_band_text(ladder.reference.of(quantity)) for quantity in QUANTITIES]
    lines.append(line(ladder.reference, f"  {_BAND_ROW}", bands, ""))
    if ladder.neighbour is not None:
        lines += ["", convergence(ladder)]
    return "\n".join([*lines, "", *_LEGEND, "", *closing(ladder)])


def json_object(ladder: Ladder) -> dict[str, Any]:
    """Gather everything that a ladder found for JSON; what is not known is NaN."""
    return {
        "scene": ladder.scene,
        "purpose": ladder.purpose,
        "versions": {name: _version(name) for name in ("beardyn", "numba", "numpy", "scipy")},
        "machine": machine(),
        "compared": {
            "settling_s": ladder.settling,
            "window_edges_s": ladder.edges,
            "cage_revolutions": ladder.revolutions,
            "fault_line": None if ladder.fault_line is None else asdict(ladder.fault_line),
        },
        "accuracy": ladder.accuracy,
        "quantities": ladder.asked,
        "vibration_limit_dB": BAND_LIMIT_DB,
        "reference": _row(ladder, ladder.reference),
        "neighbour": None if ladder.neighbour is None else ladder.neighbour.level.name,
        "unconverged": ladder.unconverged,
        "levels": [_row(ladder, row) for row in ladder.rows],
        "efficient": [row.level.name for row in ladder.efficient],
        "cheapest": None if ladder.cheapest is None else ladder.cheapest.level.name,
        "interrupted": ladder.interrupted,
    }


def _row(ladder: Ladder, row: LevelResult) -> dict[str, Any]:
    level, score = row.level, ladder.score(row)
    held, absent, other = _against_reference(ladder, level)
    return {
        "name": level.name,
        "tier": level.tier,
        "effects_name": level.effects_name,
        "effects": held,
        "less_than_reference": absent,
        "other_than_reference": other,
        "laminae": level.laminae,
        "steps_per_sample": level.steps_per_sample,
        "step_s": 1.0 / (WAVEFORM_RATE * level.steps_per_sample),
        "runs": row.runs,
        "status": row.status,
        "wall_time_per_simulated_time": asdict(row.cost),
        "real_time_factor": 1.0 / row.cost.median,
        "verdict": ladder.verdict(row),
        "score": None if score is None else asdict(score),
        "errors": {error.quantity: _error(error) for error in row.errors if error.parts},
        "values": [
            {"quantity": measure.quantity, "parts": measure.parts, "values": values}
            for measure, values in zip(MEASURES, row.values, strict=False)
        ],
    }


def _error(error: QuantityError) -> dict[str, Any]:
    assert error.worst is not None
    worst, *parts = (
        {"name": part.name, "error": part.error, "band": part.band, "resolved": part.resolved}
        for part in (error.worst, *error.parts)
    )
    return {"unit": "share" if error.unit == "%" else error.unit, "worst": worst, "parts": parts}


def _version(name: str) -> str:
    with suppress(PackageNotFoundError):
        return version(name)
    return "source"


def machine() -> dict[str, Any]:
    """Describe the machine that the wall times were measured on."""
    cpu = Path("/proc/cpuinfo")
    models = [
        line.partition(":")[2].strip()
        for line in (cpu.read_text(encoding="utf-8").splitlines() if cpu.exists() else ())
        if line.startswith("model name")
    ]
    return {
        "processor": models[0] if models else platform.processor() or platform.machine(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
    }
