"""Accuracy against wall time: the ladder in one picture. Needs no screen."""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from beardyn_core.study.ladder_report import percent
from beardyn_core.study.ladder_result import Ladder, RungResult, Score

WIDTH_PX, HEIGHT_PX, DPI = 1100, 720, 100
_MARKERS = {"lumped": "^", "quasistatic": "s", "full": "o"}
_COLOURS = ("#4C72B0", "#DD8452", "#55A868", "#C44E52", "#8172B3", "#937860", "#DA8BC3", "#64B5CD")
_LOWEST = 1.0e-2  # smaller scores are drawn here
_LINE_HEIGHT = 0.036  # of a label, of the height of the axes


def ladder_picture(ladder: Ladder, path: Path) -> None:
    """Draw the worst of the asked errors, in units of its limit, against wall time per simulated second.

    Parameters
    ----------
    ladder : Ladder
    path : Path
        Where the PNG goes.
    """
    ladder_figure(ladder).savefig(path, dpi=DPI, format="png")


def ladder_figure(ladder: Ladder) -> Figure:
    """The picture as a figure."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    scored = [(row, score) for row in ladder.rows if (score := ladder.score(row)) is not None]
    efficient = [(row, score) for row in ladder.efficient if (score := ladder.score(row)) is not None]
    axes.set_xscale("log")
    axes.set_yscale("log")
    _draw_rungs(axes, scored)
    axes.plot(
        [row.cost.median for row, _ in efficient],
        [_height(score) for _, score in efficient],
        color="0.35", lw=1.2, ls="-", zorder=1, label="efficient",
    )  # fmt: skip
    _frame(axes, ladder)
    _name(axes, efficient)
    return figure


def _height(score: Score) -> float:
    return max(score.value, _LOWEST)


def _draw_rungs(axes: Axes, scored: list[tuple[RungResult, Score]]) -> None:
    names = list(dict.fromkeys(row.rung.effects_name for row, _ in scored))
    colours = {name: _COLOURS[i % len(_COLOURS)] for i, name in enumerate(names)}
    for row, score in scored:
        height, colour = _height(score), colours[row.rung.effects_name]
        below = height - max(height - score.bar, 0.5 * _LOWEST)
        axes.errorbar(
            row.cost.median, height, yerr=[[max(below, 0.0)], [score.bar]],
            color=colour, marker=_MARKERS[row.rung.tier], ms=8, mew=1.5,
            mfc=colour if score.resolved else "white", elinewidth=1.0, capsize=2.5, ls="none",
        )  # fmt: skip
    for tier in dict.fromkeys(row.rung.tier for row, _ in scored):
        axes.plot([], [], color="0.4", marker=_MARKERS[tier], ls="none", label=tier)
    for name, colour in colours.items():
        axes.plot([], [], color=colour, lw=6, label=f"effects {name}")
    if any(not score.resolved for _, score in scored):
        axes.plot([], [], color="0.4", marker="o", mfc="white", ls="none", label="not resolved")


def _frame(axes: Axes, ladder: Ladder) -> None:
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, 0.5 * _LOWEST), max(high, 3.0))
    left, right = axes.get_xlim()
    axes.set_xlim(left, max(right, 1.3 * ladder.reference.cost.median))
    axes.axhspan(axes.get_ylim()[0], 1.0, color="#55A868", alpha=0.10, lw=0)
    axes.axhline(1.0, color="#55A868", lw=1.0)
    axes.text(
        0.005, 1.0, f" accuracy {percent(ladder.accuracy)} met below",
        transform=axes.get_yaxis_transform(), color="#3b7a4b", fontsize=9, va="bottom",
    )  # fmt: skip
    top = axes.get_xaxis_transform()
    for place, text in ((1.0, "real time"), (ladder.reference.cost.median, "reference")):
        axes.axvline(place, color="0.5", lw=1.0, ls=":")
        axes.text(place, 0.012, f" {text}", transform=top, color="0.4", fontsize=9, rotation=90, va="bottom")
    axes.grid(which="both", alpha=0.2)
    axes.set_xlabel("wall time per simulated second [s]")
    axes.set_ylabel("worst error in units of its limit")
    axes.set_title(
        f"{ladder.scene}: accuracy against wall time\n{', '.join(ladder.asked)}; bars: run-to-run band",
        fontsize=11, loc="left",
    )  # fmt: skip
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def _name(axes: Axes, efficient: list[tuple[RungResult, Score]]) -> None:
    """Write the names of the efficient rungs beside them, the higher ones first, none over another."""
    to_axes = axes.transData + axes.transAxes.inverted()
    free = 1.0
    for row, score in sorted(efficient, key=lambda item: -item[1].value):
        x, y = to_axes.transform((row.cost.median, _height(score)))
        height = min(y + 0.02, free - _LINE_HEIGHT)
        free = height
        right = x < 0.6
        axes.annotate(
            f"{row.rung.name}: {score.quantity}",
            (row.cost.median, _height(score)), xycoords="data",
            xytext=(x + (0.02 if right else -0.02), height), textcoords="axes fraction",
            fontsize=8.5, ha="left" if right else "right", va="center",
            arrowprops={"arrowstyle": "-", "color": "0.6", "lw": 0.6, "shrinkB": 4},
        )  # fmt: skip
