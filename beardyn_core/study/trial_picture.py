"""A trial in one picture: detection rate over size, and scores against the threshold. Needs no screen."""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullLocator

from beardyn_core.monitor.chain import FAULTS as PARTS
from beardyn_core.scene.trial import CAGE, HEALTHY
from beardyn_core.study.trial_report import rate_text
from beardyn_core.study.trial_result import FOUND_AT, TrialResult, own_score

WIDTH_PX, HEIGHT_PX, DPI = 1200, 520, 100
_COLOURS = {"cup": "#4C72B0", "cone": "#DD8452", "roller": "#55A868", CAGE: "#8172B3"}
_APART = 1.03  # by which neighbours are moved, so that their bars do not cover each other


def trial_picture(result: TrialResult, path: Path) -> None:
    """Draw detection rates with their intervals, and every run's score, to a PNG."""
    trial_figure(result).savefig(path, dpi=DPI, format="png")


def trial_figure(result: TrialResult) -> Figure:
    """Draw a figure of two axes: rates, scores."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, layout="constrained")
    rates, scores = figure.subplots(1, 2)
    _draw_rates(rates, result)
    _draw_scores(scores, result)
    monitor = result.algorithm or "monitor of beardyn"
    figure.suptitle(
        f"{monitor}, trial {result.trial.name}, tier {result.trial.tier}: "
        f"false alarms in {rate_text(result.false_alarms())} of healthy runs",
        fontsize=11,
    )
    return figure


def _draw_rates(axes: Axes, result: TrialResult) -> None:
    rows = result.sizes()
    for place, fault in enumerate(result.trial.faults):
        own = [row for row in rows if row.fault == fault and row.found.total]
        width = [1e3 * row.size * _APART ** (place - 1) for row in own]
        value = [row.found.value for row in own]
        below = [max(0.0, row.found.value - row.found.low) for row in own]
        above = [max(0.0, row.found.high - row.found.value) for row in own]
        label = "worn pocket of the cage" if fault == CAGE else f"spall on {fault}"
        axes.errorbar(width, value, (below, above), marker="o", capsize=3, color=_COLOURS[fault], label=label)
    axes.axhline(FOUND_AT, color="0.6", linewidth=0.8, linestyle="--")
    axes.set(ylim=(-0.03, 1.03), ylabel="found and named right, with 95 % interval")
    _size_axis(axes, result)
    axes.legend(loc="upper left")


def _draw_scores(axes: Axes, result: TrialResult) -> None:
    for place, fault in enumerate(result.trial.faults):
        own = [(cell, run) for cell, run in result.runs if cell.fault == fault and run.complete]
        width = [1e3 * cell.size * _APART ** (place - 1) for cell, _ in own]
        score = [own_score(cell, run) for cell, run in own]
        axes.plot(width, score, ".", color=_COLOURS[fault], alpha=0.5)
    healthy = [run for cell, run in result.runs if cell.fault == HEALTHY and run.complete]
    left = 0.6e3 * min(result.trial.sizes)
    for part in range(len(PARTS)):
        axes.plot([left] * len(healthy), [run.scores[part] for run in healthy], ".", color="0.5", alpha=0.5)
    thresholds = [run.threshold for _, run in result.runs if run.threshold == run.threshold]
    if thresholds:
        axes.axhspan(min(thresholds), max(thresholds), color="#C44E52", alpha=0.2, linewidth=0.0)
        axes.text(1e3 * max(result.trial.sizes), max(thresholds), "thresholds", ha="right", va="bottom")
    axes.set_ylabel("score of the spalled part, dB over noise")
    _size_axis(axes, result)
    axes.text(left, -0.06, "healthy", ha="center", va="top", transform=axes.get_xaxis_transform())


def _size_axis(axes: Axes, result: TrialResult) -> None:
    axes.set_xscale("log")
    axes.set_xticks([1e3 * size for size in result.trial.sizes])
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("width of the spall, mm" if result.trial.faults != (CAGE,) else "wear of the pocket, mm")
    axes.grid(alpha=0.3)
