"""A trial as table and as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import Any

from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.scene.trial import HEALTHY
from beardyn_core.study.trial_result import (
    CONFIDENCE,
    FOUND_AT,
    Rate,
    Smallest,
    TrialResult,
    Where,
    everywhere,
    false_alarms,
)


def table(result: TrialResult) -> str:
    """Write the result for the terminal."""
    return "\n".join(_lines(result))


def slices(result: TrialResult) -> list[tuple[str, Where]]:
    """List speeds, tracks and wheels of the matrix: a name, and whether a cell belongs to it."""

    def within(field: str, value: object) -> Where:
        return lambda cell: getattr(cell, field) == value

    trial = result.trial
    return [
        *((f"{3.6 * speed:g} km/h", within("speed", speed)) for speed in trial.speeds),
        *((track, within("track", track)) for track in trial.tracks),
        *((f"{wheel.name} wheel", within("wheel", wheel.name)) for wheel in trial.wheels),
        *((f"{shape} spalls", within("shape", shape)) for shape in trial.shapes if len(trial.shapes) > 1),
        *((sensor, within("sensor", sensor)) for sensor in trial.sensors),
        *((f"{surface} surface", within("surface", surface)) for surface in trial.surfaces),
    ]


def rate_text(rate: Rate) -> str:
    """Write a rate such as ``35/36  97 % (85 to 100)``."""
    if not rate.total:
        return "no runs"
    interval = f"({100.0 * rate.low:.3g} to {100.0 * rate.high:.3g})"
    return f"{rate.count}/{rate.total}  {100.0 * rate.value:.3g} % {interval}"


def smallest_text(smallest: Smallest) -> str:
    """Write a smallest size such as ``cup: 4 mm (2 to 6 mm)``."""
    if smallest.size is None:
        return f"{smallest.fault}: none of these sizes"
    high = "beyond the largest" if smallest.high is None else f"{1e3 * smallest.high:g} mm"
    low = smallest.low if smallest.low is not None else smallest.size
    return f"{smallest.fault}: {1e3 * smallest.size:g} mm ({1e3 * low:g} mm to {high})"


def expected_false_alarms(result: TrialResult) -> float:
    """Count the false alarms that the stated rate allows in the healthy analyses there were."""
    return MonitorSettings().false_alarm_rate * result.false_analyses().total


def _lines(result: TrialResult) -> Iterator[str]:
    trial = result.trial
    faulty = sum(cell.fault != HEALTHY for cell, _ in result.runs)
    yield f"{trial.name}: {trial.purpose}"
    yield (
        f"monitor {result.algorithm or 'of beardyn'}; tier {trial.tier}; {faulty} runs with a spall, "
        f"{len(result.runs) - faulty} without; {trial.revolutions:g} revolutions each; seed {trial.seed}"
    )
    if result.invalid:
        yield f"{len(result.invalid)} runs did not come to their end and count nowhere, such as:"
        yield f"  {result.invalid[0][0].key}: {result.invalid[0][1].status}"
    yield ""
    if trial.faults:
        yield from _size_lines(result)
    yield f"{'':24}{'found (95 %)':34}healthy runs with a false alarm (95 %)"
    for name, where in [("all", everywhere), *slices(result)]:
        yield f"{name:24}{rate_text(result.detection(where)):34}{rate_text(result.false_alarms(where))}"
    analyses = result.false_analyses()
    yield f"Healthy analyses with an alarm: {rate_text(analyses)}"
    for cell, run in result.alarmed:
        yield from (f"  {cell.key}: {sentence}" for sentence in run.called)
    if not result.algorithm:
        yield (
            f"The threshold allows {100.0 * MonitorSettings().false_alarm_rate:g} % in stationary noise: "
            f"{expected_false_alarms(result):.2g} of {analyses.total}"
        )
    if result.checks:
        yield ""
        yield from _check_lines(result)


def _size_lines(result: TrialResult) -> Iterator[str]:
    yield f"{'spall on':10}{'width':>8}   {'found, named right (95 %)':32}{'wrong':>6}   score dB (range)"
    for row in result.sizes():
        low, middle, high = row.score
        scores = f"{middle:5.1f} ({low:.1f} to {high:.1f})" if isfinite(middle) else "-"
        yield f"{row.fault:10}{1e3 * row.size:5g} mm   {rate_text(row.found):32}{row.wrong:6d}   {scores}"
    yield ""
    yield f"Smallest width found in {100.0 * FOUND_AT:g} % of the runs, and at every larger one (95 %):"
    for smallest in result.smallest():
        yield f"  {smallest_text(smallest)}"
    yield ""


def _check_lines(result: TrialResult) -> Iterator[str]:
    trial, pairs = result.trial, result.pairs()
    yield f"Tier {trial.tier} against {trial.check_tier}, {len(pairs)} runs in both:"
    yield f"  same verdict: {rate_text(result.agreement())}"
    yield f"  false alarms in {trial.check_tier}: {rate_text(_false_alarms_in_check(result))}"
    low, middle, high = result.score_differences()
    if isfinite(middle):
        yield (
            f"  score in {trial.check_tier} less that in {trial.tier}, spalls found in both: "
            f"median {middle:+.1f} dB ({low:+.1f} to {high:+.1f})"
        )
    for cell, own, other in pairs:
        if own.verdict != other.verdict:
            yield f"  {cell.conditions}: {own.verdict} in {trial.tier}, {other.verdict} in {cell.tier}"


def _false_alarms_in_check(result: TrialResult) -> Rate:
    return false_alarms([(cell, run) for cell, _, run in result.pairs()])


def json_object(result: TrialResult) -> dict[str, Any]:
    """Gather the result for JSON, in SI units, rates with their 95 % intervals."""
    trial = result.trial
    return {
        "trial": trial.name,
        "purpose": trial.purpose,
        "monitor": result.algorithm,
        "scene": trial.scene,
        "tier": trial.tier,
        "check_tier": trial.check_tier,
        "seed": trial.seed,
        "revolutions": trial.revolutions,
        "confidence": CONFIDENCE,
        "stated_false_alarm_rate": MonitorSettings().false_alarm_rate,
        "run_count": len(result.runs),
        "invalid": [{"run": cell.key, "status": run.status} for cell, run in result.invalid],
        "sizes": [
            {
                "fault": row.fault,
                "width_m": row.size,
                "found": _rate(row.found),
                "wrong": row.wrong,
                "score_dB": _spread(row.score),
                "surfaces": [
                    {"surface": surface, "found": _rate(found)} for surface, found in row.on_surfaces
                ],
            }
            for row in result.sizes()
        ],
        "smallest": [
            {"fault": each.fault, "width_m": each.size, "low_m": each.low, "high_m": each.high}
            for each in result.smallest()
        ],
        "slices": [
            {
                "name": name,
                "found": _rate(result.detection(where)),
                "false_alarms": _rate(result.false_alarms(where)),
            }
            for name, where in [("all", everywhere), *slices(result)]
        ],
        "false_analyses": _rate(result.false_analyses()),
        "alarms": [{"run": cell.key, "called": list(run.called)} for cell, run in result.alarmed],
        "check": {
            "agreement": _rate(result.agreement()),
            "false_alarms": _rate(_false_alarms_in_check(result)),
            "score_difference_dB": _spread(result.score_differences()),
            "different": [
                {"run": cell.conditions, "verdict": own.verdict, "check_verdict": other.verdict}
                for cell, own, other in result.pairs()
                if own.verdict != other.verdict
            ],
        }
        if result.checks
        else None,
    }


def _rate(rate: Rate) -> dict[str, Any]:
    return {"count": rate.count, "total": rate.total, "rate": rate.value, "low": rate.low, "high": rate.high}


def _spread(values: tuple[float, float, float]) -> dict[str, float]:
    return dict(zip(("smallest", "median", "largest"), values, strict=True))
