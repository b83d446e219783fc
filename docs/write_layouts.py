"""Write the layouts for Foxglove and PlotJuggler: ``python docs/write_layouts.py``.

Both show the same plots of the same topics; ``--check`` writes nothing and ends with 1 when the files are not
those.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

from beardyn_core.record.topics import NAMESPACE

FOLDER = Path(__file__).parents[1] / "layouts"
COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#ff7f0e")


class Curve(NamedTuple):
    """One line of a plot: its name, where Foxglove finds it, where PlotJuggler does."""

    label: str
    foxglove: str
    plotjuggler: str


def vector(topic: str, members: str, axes: str, names: str) -> list[Curve]:
    """List the components of a vector in a message."""
    return [
        Curve(f"{name}{axis}", f"{topic}.{members}.{axis}", f"{topic}/{members.replace('.', '/')}/{axis}")
        for name, axis in zip(names.split(), axes, strict=True)
    ]


def joint(topic: str, name: str, place: int, member: str) -> Curve:
    """Find one joint of a joint state."""
    return Curve(name, f"{topic}.{member}[{place}]", f"{topic}/{name}/{member}")


def plots() -> dict[str, list[Curve]]:
    """List the plots, each by its title with the unit."""
    force, imu, shaft = (f"{NAMESPACE}/{name}" for name in ("force", "imu", "shaft"))
    joints = f"{NAMESPACE}/joint_states"
    return {
        "force of the rollers on the cup, N": vector(force, "wrench.force", "xyz", "f f f"),
        "vibration, decimated to 400 Hz, m/s^2": vector(imu, "linear_acceleration", "xyz", "a a a"),
        "shaft speed, rad/s": [joint(shaft, "shaft", 0, "velocity")],
        "cages and two rollers, rad/s": [
            joint(joints, name, place, "velocity")
            for name, place in {"cage_0": 0, "cage_1": 1, "roller_0_0": 2, "roller_0_1": 3}.items()
        ],
    }


def foxglove() -> str:
    """Write the layout of Foxglove: the plots, the diagnostics, and the truth of the run."""
    panels: dict[str, Any] = {}
    for number, (title, curves) in enumerate(plots().items()):
        paths = [
            {
                "value": curve.foxglove,
                "label": curve.label,
                "color": colour,
                "enabled": True,
                "timestampMethod": "headerStamp",
            }
            for curve, colour in zip(curves, COLOURS, strict=False)
        ]
        panels[f"Plot!beardyn{number}"] = {
            "foxglovePanelTitle": title,
            "paths": paths,
            "xAxisVal": "timestamp",
            "showLegend": True,
            "legendDisplay": "floating",
            "isSynced": True,
        }
    panels["DiagnosticSummary!beardyn"] = {"topicToRender": "/diagnostics"}
    panels["RawMessages!beardyn"] = {"topicPath": f"{NAMESPACE}/truth.data"}
    sides = {"first": "DiagnosticSummary!beardyn", "second": "RawMessages!beardyn", "direction": "column"}
    column: Any = f"Plot!beardyn{len(plots()) - 1}"
    for number in reversed(range(len(plots()) - 1)):
        share = 100.0 / (len(plots()) - number)
        column = {
            "first": f"Plot!beardyn{number}",
            "second": column,
            "direction": "column",
            "splitPercentage": share,
        }
    whole = {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": {"first": column, "second": sides, "direction": "row", "splitPercentage": 70},
    }
    return json.dumps(whole, indent=2) + "\n"


def plotjuggler() -> str:
    """Write the layout of PlotJuggler."""
    root = ElementTree.Element("root")
    tabs = ElementTree.SubElement(root, "tabbed_widget", parent="main_window", name="Main Window")
    container = ElementTree.SubElement(
        ElementTree.SubElement(tabs, "Tab", containers="1", tab_name="beardyn"), "Container"
    )
    count = len(plots())
    sizes = ";".join([f"{1 / count:.6f}"] * count)
    splitter = ElementTree.SubElement(
        container, "DockSplitter", orientation="-", count=str(count), sizes=sizes
    )
    for title, curves in plots().items():
        area = ElementTree.SubElement(splitter, "DockArea", name=title)
        plot = ElementTree.SubElement(
            area, "plot", mode="TimeSeries", style="Lines", flip_x="false", flip_y="false"
        )
        for curve, colour in zip(curves, COLOURS, strict=False):
            ElementTree.SubElement(plot, "curve", name=curve.plotjuggler, color=colour)
    ElementTree.SubElement(tabs, "currentTabIndex", index="0")
    ElementTree.SubElement(root, "use_relative_time_offset", enabled="1")
    ElementTree.indent(root)
    return "<?xml version='1.0' encoding='UTF-8'?>\n" + ElementTree.tostring(root, encoding="unicode") + "\n"


def main(arguments: list[str]) -> int:
    """Write, or check."""
    files = {FOLDER / "foxglove.json": foxglove(), FOLDER / "plotjuggler.xml": plotjuggler()}
    if arguments == ["--check"]:
        return int(
            any(not path.exists() or path.read_text(encoding="utf-8") != text for path, text in files.items())
        )
    for path, text in files.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
