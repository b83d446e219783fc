"""Write docs/nodes.md from the tables that the nodes themselves use: ``python docs/write_nodes.py``.

Needs rclpy (the node modules import it).
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from beardyn_core.record.topics import TOPICS
from beardyn_ros.__main__ import PROGRAMS
from beardyn_ros.runtime import EXIT_CODES

PAGE = Path(__file__).with_name("nodes.md")
NODES = ("twin", "load", "recorder", "monitor", "viewer")

HEAD = """# Nodes

Written by `python docs/write_nodes.py` from the tables in the code.

Every node starts with `ros2 run beardyn NODE` or `python -m beardyn_ros NODE`, takes parameters as
`--ros-args -p NAME:=VALUE` or `--params-file FILE`, refuses unknown names and bad values with a
sentence, and ends cleanly on SIGINT and SIGTERM.
"""

SERVICES = """
Services of the twin, in its namespace: `pause` (`std_srvs/SetBool`), `step` (`std_srvs/Trigger`, one
block while paused) and `reset` (`std_srvs/Trigger`, back to t = 0; a reset starts a new recording). The
twin is a lifecycle node: configure loads the scene and compiles off the executor, activate solves the
equilibrium under the first load and runs; with `autostart` it does both by itself.
"""

PROTOCOL = """
## Load protocol

`load/blocks` is reliable and keeps all. The load node stays within `horizon` of the simulated time that
the twin repeats on `load/consumed` every 0.2 s; an empty block ends the stream. Samples are linear in
between, and in lockstep a block is computed only when a sample at or after its end has arrived: the
signals are the same to the last bit at any speed. Messages with NaN, out of order, with gaps or absurd
numbers are counted and refused in `/diagnostics`.
"""


def parameter_rows(node: str) -> list[str]:
    """Table rows of one node's parameters."""
    rows = []
    for parameter in import_module(f"beardyn_ros.{PROGRAMS[node][0]}").PARAMETERS:
        allowed = ", ".join(parameter.choices) if parameter.choices else parameter.allowed_range
        allowed = {"no range": parameter.unit}.get(allowed, allowed)
        default = f"`{parameter.default}`" if parameter.default != "" else ""
        name = f"`{parameter.name}`"
        rows.append(f"| {name} | {parameter.type_name} | {default} | {allowed} | {parameter.description} |")
    return rows


def page() -> str:
    """The whole page."""
    lines = [HEAD, "| exit code | meaning |", "|---|---|"]
    lines += [*(f"| {code} | {meaning} |" for code, meaning in EXIT_CODES.items()), ""]
    for node in NODES:
        lines += [f"## {node}", "", f"{PROGRAMS[node][1].capitalize()}.", ""]
        lines += ["| parameter | type | default | allowed | meaning |", "|---|---|---|---|---|"]
        lines += [*parameter_rows(node), ""]
        lines += [SERVICES] if node == "twin" else []
    lines += [PROTOCOL, "## Topics", "", "| topic | type | QoS | rate | content |", "|---|---|---|---|---|"]
    for topic in TOPICS:
        quality = topic.reliability + (", latched" if topic.durability == "transient_local" else "")
        lines.append(f"| `{topic.name}` | `{topic.type}` | {quality} | {topic.rate} | {topic.content} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
