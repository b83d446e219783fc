"""Write the layouts for Foxglove and PlotJuggler: ``python docs/write_layouts.py``.

Both show the same plots of the same topics, and Foxglove every sample of a block; ``--check`` writes nothing
and ends with 1 when the files are not those.
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


class Plot(NamedTuple):
    """One plot: its title with the unit, its curves, and what is along its x axis."""

    title: str
    curves: list[Curve]
    over: str = "timestamp"  # or "index": the samples of the latest array


def value(name: str, *labels: str) -> list[Curve]:
    """List the curves of a value: itself, and the ends of its interval where they have a label."""
    topic = f"{NAMESPACE}/values/{name}"
    return [
        Curve(label, f"{topic}.vector.{axis}", f"{topic}/vector/{axis}")
        for label, axis in zip(labels, "xyz", strict=False)
    ]


def signals() -> list[Plot]:
    """List the plots of signals."""
    force, imu, shaft = (f"{NAMESPACE}/{name}" for name in ("force", "imu", "shaft"))
    joints = f"{NAMESPACE}/joint_states"
    return [
        Plot("force of the rollers on the cup, N", vector(force, "wrench.force", "xyz", "f f f")),
        Plot("vibration, decimated to 400 Hz, m/s^2", vector(imu, "linear_acceleration", "xyz", "a a a")),
        Plot("shaft speed, rad/s", [joint(shaft, "shaft", 0, "velocity")]),
        Plot(
            "cages and two rollers, rad/s",
            [
                joint(joints, name, place, "velocity")
                for name, place in {"cage_0": 0, "cage_1": 1, "roller_0_0": 2, "roller_0_1": 3}.items()
            ],
        ),
    ]


def results() -> list[Plot]:
    """List the plots of the results of monitor and follower."""
    ends = ("from", "to")
    return [
        Plot(
            "verdict and health, as codes; from 10 on a fault",
            [*value("verdict", "verdict"), *value("health", "health")],
        ),
        Plot("width of the spall with its 95 % interval, m", value("spall_width", "width", *ends)),
        Plot("vertical load with its 90 % interval, N", value("vertical_load", "load", *ends)),
        Plot("end play with its 90 % interval, m", value("end_play", "end play", *ends)),
    ]


def samples() -> Plot:
    """Describe the plot of every sample of the latest block, which only Foxglove has."""
    topic = f"{NAMESPACE}/vibration_samples"
    curves = [Curve(f"a{axis}", f"{topic}.polygon.points[:].{axis}", "") for axis in "xyz"]
    return Plot("vibration, every sample of a block, m/s^2", curves, "index")


RQT_PLOT = f"ros2 run rqt_plot rqt_plot {NAMESPACE}/values/verdict/vector/x {NAMESPACE}/values/rms/vector/x"
RQT_INTERVAL = f"ros2 run rqt_plot rqt_plot {NAMESPACE}/values/vertical_load/vector/x:y:z"
"""Commands of rqt_plot, as the page of viewers has them."""


def foxglove() -> str:
    """Write the layout of Foxglove: the plots, the diagnostics, and the truth of the run."""
    panels: dict[str, Any] = {}
    columns = [signals(), [samples(), *results()]]
    names: list[list[str]] = []
    for plots in columns:
        names.append([])
        for title, curves, over in plots:
            name = f"Plot!beardyn{len(panels)}"
            names[-1].append(name)
            panels[name] = {
                "foxglovePanelTitle": title,
                "paths": [
                    {
                        "value": curve.foxglove,
                        "label": curve.label,
                        "color": colour,
                        "enabled": True,
                        "timestampMethod": "headerStamp",
                    }
                    for curve, colour in zip(curves, COLOURS, strict=False)
                ],
                "xAxisVal": over,
                "showLegend": True,
                "legendDisplay": "floating",
                "isSynced": over == "timestamp",
            }
    panels["DiagnosticSummary!beardyn"] = {"topicToRender": "/diagnostics"}
    panels["RawMessages!beardyn"] = {"topicPath": f"{NAMESPACE}/truth.data"}
    names.append(["DiagnosticSummary!beardyn", "RawMessages!beardyn"])
    whole = {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": placed([placed(column, "column") for column in names], "row"),
    }
    return json.dumps(whole, indent=2) + "\n"


def placed(parts: list[Any], direction: str) -> Any:
    """Place panels side by side, or one below the other, all of one size."""
    first, *others = parts
    if not others:
        return first
    return {
        "first": first,
        "second": placed(others, direction),
        "direction": direction,
        "splitPercentage": 100.0 / len(parts),
    }


def plotjuggler() -> str:
    """Write the layout of PlotJuggler."""
    root = ElementTree.Element("root")
    tabs = ElementTree.SubElement(root, "tabbed_widget", parent="main_window", name="Main Window")
    for name, plots in {"beardyn": signals(), "results": results()}.items():
        container = ElementTree.SubElement(
            ElementTree.SubElement(tabs, "Tab", containers="1", tab_name=name), "Container"
        )
        sizes = ";".join([f"{1 / len(plots):.6f}"] * len(plots))
        splitter = ElementTree.SubElement(
            container, "DockSplitter", orientation="-", count=str(len(plots)), sizes=sizes
        )
        for title, curves, _ in plots:
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
