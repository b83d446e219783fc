"""Accuracy against wall time: the ladder in one picture. Needs no screen."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from beardyn_core.study.ladder_report import percent
from beardyn_core.study.ladder_result import Ladder, LevelResult
from beardyn_core.study.measures import QUANTITIES

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100
_MARKERS = {"lumped": "^", "quasistatic": "s", "full": "o"}
_COLOURS = ("#4C72B0", "#DD8452", "#55A868", "#C44E52", "#8172B3", "#937860", "#DA8BC3", "#64B5CD")
_GOOD = "#55A868"
_LOWEST = 1.0e-2  # what is smaller in units of its limit is drawn here
_LABEL_HEIGHT = 0.035  # of the height of the axes
_SIDE_COLUMNS = 2


@dataclass(frozen=True)
class _Point:
    """A level in a panel; heights in units of the panel."""

    row: LevelResult
    value: float
    bar: float
    resolved: bool

    @property
    def wall(self) -> float:
        return self.row.cost.median


def ladder_picture(ladder: Ladder, path: Path) -> None:
    """Draw the worst of the asked errors, in units of its limit, against wall time, to a PNG.

    Next to it each quantity alone, in its own unit.
    """
    ladder_figure(ladder).savefig(path, dpi=DPI, format="png")


def ladder_figure(ladder: Ladder) -> Figure:
    """Draw the picture as a figure; its first axes are the main panel."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, layout="constrained")
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(1.15, 1.0))[0]
    names = list(dict.fromkeys(row.level.effects_name for row in (*ladder.rows, ladder.reference)))
    colours = {name: _COLOURS[i % len(_COLOURS)] for i, name in enumerate(names)}
    main = left.subplots()
    points = [
        _Point(row, score.value, score.bar, score.resolved)
        for row in ladder.rows
        if (score := ladder.score(row)) is not None
    ]
    _panel(main, ladder, points, 1.0, colours)
    _dress(main, ladder, points, colours)
    shown = [quantity for quantity in QUANTITIES if any(_point(row, quantity) for row in ladder.rows)]
    rows = max(-(-len(shown) // _SIDE_COLUMNS), 1)
    panels = right.subplots(rows, _SIDE_COLUMNS, squeeze=False, sharex=True).ravel()
    for axes, quantity in zip(panels, shown, strict=False):
        _side_panel(axes, ladder, quantity, colours)
    for axes in panels[len(shown) :]:
        axes.set_visible(False)
    for axes in panels[max(len(shown) - _SIDE_COLUMNS, 0) : len(shown)]:
        axes.tick_params(labelbottom=True)
    right.supxlabel("wall time per simulated second [s]", fontsize=10)
    return figure


def _point(row: LevelResult, quantity: str) -> _Point | None:
    """Return a level's error in one quantity, in % or dB."""
    error = row.of(quantity)
    if error is None or error.worst is None:
        return None
    worst, unit = error.worst, 100.0 if error.unit == "%" else 1.0
    return _Point(row, unit * abs(worst.error), unit * worst.band, worst.resolved)


def _side_panel(axes: Axes, ladder: Ladder, quantity: str, colours: dict[str, str]) -> None:
    points = [point for row in ladder.rows if (point := _point(row, quantity)) is not None]
    error = points[0].row.of(quantity)
    assert error is not None
    limit = error.limit(ladder.accuracy) * (100.0 if error.unit == "%" else 1.0)
    _panel(axes, ladder, points, limit, colours, size=6.0)
    line = "" if quantity != "fault_line" or ladder.fault_line is None else f" {ladder.fault_line.name}"
    asked = "" if quantity in ladder.asked else " (not asked)"
    name = quantity.replace("_", " ")
    axes.set_title(f"{name}{line} [{error.unit}]{asked}", fontsize=10, loc="left")
    axes.tick_params(labelsize=9)


def _panel(
    axes: Axes, ladder: Ladder, points: list[_Point], limit: float, colours: dict[str, str], size: float = 8.0
) -> None:
    """Draw points with their bands on logarithmic axes, the limit, and the good region below it."""
    axes.set(xscale="log", yscale="log")
    lowest = _LOWEST * limit
    heights = [max(point.value, lowest) for point in points] or [limit]
    bottom, top = min(0.5 * min(heights), 0.6 * limit), max(1.8 * max(heights), 2.0 * limit)
    for point, height in zip(points, heights, strict=True):
        colour = colours[point.row.level.effects_name]
        below = min(point.bar, height - 0.5 * bottom)
        axes.errorbar(
            point.wall, height, yerr=[[below], [point.bar]],
            color=colour, marker=_MARKERS[point.row.level.tier], ms=size, mew=0.18 * size,
            mfc=colour if point.resolved else "white", elinewidth=0.9, capsize=0.3 * size, ls="none",
        )  # fmt: skip
    axes.set_ylim(bottom, top)
    walls = [row.cost.median for row in (*ladder.rows, ladder.reference)]
    axes.set_xlim(0.7 * min(walls), 1.5 * max(walls))
    axes.axhspan(bottom, limit, color=_GOOD, alpha=0.10, lw=0)
    axes.axhline(limit, color=_GOOD, lw=1.0)
    for place in (1.0, ladder.reference.cost.median):
        axes.axvline(place, color="0.5", lw=1.0, ls=":")
    axes.grid(which="both", alpha=0.2)
    for scale in (axes.xaxis, axes.yaxis):
        scale.set_major_locator(LogLocator(subs=(1.0, 3.0)))
        scale.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        scale.set_minor_formatter(NullFormatter())


def _dress(axes: Axes, ladder: Ladder, points: list[_Point], colours: dict[str, str]) -> None:
    """Write title, names and legend of the main panel."""
    names = {row.level.name for row in ladder.efficient}
    efficient = [point for point in points if point.row.level.name in names]
    efficient.sort(key=lambda point: point.wall)
    axes.plot(
        [point.wall for point in efficient],
        [max(point.value, _LOWEST) for point in efficient],
        color="0.35", lw=1.2, zorder=1, label="efficient",
    )  # fmt: skip
    axes.text(
        0.008, 1.0, f"accuracy {percent(ladder.accuracy)} met below",
        transform=axes.get_yaxis_transform(), color="#3b7a4b", fontsize=9, va="bottom",
    )  # fmt: skip
    for place, text in ((1.0, "real time"), (ladder.reference.cost.median, "reference")):
        axes.text(
            place, 0.012, f" {text}",
            transform=axes.get_xaxis_transform(), color="0.4", fontsize=9, rotation=90, va="bottom",
        )  # fmt: skip
    for tier in dict.fromkeys(point.row.level.tier for point in points):
        axes.plot([], [], color="0.4", marker=_MARKERS[tier], ls="none", label=tier)
    for name in dict.fromkeys(point.row.level.effects_name for point in points):
        axes.plot([], [], color=colours[name], lw=6, label=f"effects {name}")
    axes.plot([], [], color="0.4", marker="o", mfc="white", ls="none", label="not resolved")
    axes.set(xlabel="wall time per simulated second [s]")
    axes.set(ylabel="worst of the asked errors, in units of its limit")
    title = (
        f"{ladder.scene}: accuracy against wall time\nasked: {', '.join(ladder.asked)}; bars: run-to-run band"
    )
    axes.set_title(title, fontsize=11, loc="left")
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.09), frameon=False, ncols=4)
    _name(axes, efficient, ladder)


def _name(axes: Axes, efficient: list[_Point], ladder: Ladder) -> None:
    """Write the names of the efficient levels next to them, the higher ones first, none over another."""
    to_axes = axes.transData + axes.transAxes.inverted()
    free = 1.0
    for point in sorted(efficient, key=lambda point: -point.value):
        score = ladder.score(point.row)
        assert score is not None
        place = (point.wall, max(point.value, _LOWEST))
        x, y = to_axes.transform(place)
        free = min(y + 0.025, free - _LABEL_HEIGHT)
        right = x < 0.55
        axes.annotate(
            f"{point.row.level.name}: {score.quantity}",
            place, xycoords="data",
            xytext=(x + (0.025 if right else -0.025), free), textcoords="axes fraction",
            fontsize=8.5, ha="left" if right else "right", va="center",
            arrowprops={"arrowstyle": "-", "color": "0.6", "lw": 0.6, "shrinkB": 4},
        )  # fmt: skip
