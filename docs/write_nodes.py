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

LOAD_SERVICES = """
Services of the load node, in its namespace: `load/pause` (`std_srvs/SetBool`), `load/step`
(`std_srvs/Trigger`, one block of load while paused, lockstep only) and `load/reset` (`std_srvs/Trigger`,
a seek to 0). `position`, `loop` and `speed_factor` may change while it runs:

```
ros2 param set /axlebox/load position 12.5     # seek
ros2 param set /axlebox/load loop true
ros2 service call /axlebox/load/pause std_srvs/srv/SetBool "{data: true}"
```

Sample numbers and stamps always go on; a seek or a loop only moves the position in the scenario, with a
cross-fade of half a cosine over `fade` in which force, moment, speed and bogie of both places are mixed:
the load never jumps. A lap of a loop is the length of the scenario less one fade. What is sent already is
not taken back: in lockstep a seek, a loop or a pause reaches the twin up to `horizon` later. `load/truth`
says which stamp stands where, before the load that it is about comes: `replay.passages` lists, for each
passage, its first `sample` and `stamp_s`, its `position_s` there, and for how long (`fade_s`) the passage
before it still fades out. At the stamp t of a passage the position is `position_s + t - stamp_s`.

A pause is also published on `load/truth`, and the twin then waits in either mode: simulated time stands
still, neither `load_timeout` nor `max_age` runs, and the age of a live load counts anew when it goes on. When
a source falls silent without announcing a pause, or dies while paused (Fast DDS reports it within 10 s), the
load is lost as ever. Reset of the twin starts the stream again at sample 0 and the first stamp.

### A recording in its place

Any node may send the load. A recording of a lockstep run replays to the same bits:

```
ros2 bag play run.mcap --topics /axlebox/load/blocks /axlebox/load/truth
```

A bag does not wait for credit: with `--rate` it may run ahead of the twin by `load_queue` seconds or
`load_queue_size` MB, beyond which the twin stops and says so.
"""

RECORDER = """
The last word of the twin on `/diagnostics` says how many messages of every topic it has published (values
`messages TOPIC`). The recorder waits for what is still on its way, then says which topics lack how many, and
ends with 5; `beardyn report` finds the same in the file. A twin that is killed has no last word: the file
says that it vanished. Malformed messages are counted (`refused: TOPIC` in its diagnostic, as in those of
monitor and viewer) and not recorded. A disk that stalls is waited for in the background, up to 128 MB.

With `max_file_size` or `max_file_duration` a run becomes a folder as rosbag2 makes it: each file is whole in
itself and names the next one, `metadata.yaml` lists them. `beardyn report`, `view`, `export` and `monitor`
take the folder or its `metadata.yaml` in the place of a file, and so does `ros2 bag`.

### Fast DDS

Nodes that no one has given a Fast DDS profile (`FASTDDS_DEFAULT_PROFILES_FILE`) take the one of the package,
in a sourced ROS too: without it what was lost on the way is sent again up to 3 s later. A profile of your own
should have a heartbeat period of 20 ms. The twin waits for its readers in runs faster than real time; up to
real time it keeps ten seconds for a slow one.
"""

PROTOCOL = """
## Load protocol

`load/blocks` is reliable and keeps all. The load node stays within `horizon` of the simulated time that
the twin repeats on `load/consumed` every 0.2 s; an empty block ends the stream. Samples are linear in
between, and in lockstep a block is computed only when a sample at or after its end has arrived: the
signals are the same to the last bit at any speed. Messages with NaN, out of order, with gaps or absurd
numbers are counted and refused in `/diagnostics`. Every sample has a running number: a loss shows as a gap
and never as a guess.
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
    """Write the whole page."""
    lines = [HEAD, "| exit code | meaning |", "|---|---|"]
    lines += [*(f"| {code} | {meaning} |" for code, meaning in EXIT_CODES.items()), ""]
    for node in NODES:
        lines += [f"## {node}", "", f"{PROGRAMS[node][1].capitalize()}.", ""]
        lines += ["| parameter | type | default | allowed | meaning |", "|---|---|---|---|---|"]
        lines += [*parameter_rows(node), ""]
        lines += {"twin": [SERVICES], "load": [LOAD_SERVICES], "recorder": [RECORDER]}.get(node, [])
    lines += [PROTOCOL, "## Topics", "", "| topic | type | QoS | rate | content |", "|---|---|---|---|---|"]
    for topic in TOPICS:
        quality = topic.reliability + (", latched" if topic.durability == "transient_local" else "")
        lines.append(f"| `{topic.name}` | `{topic.type}` | {quality} | {topic.rate} | {topic.content} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
