"""Parameters of the load node."""

from __future__ import annotations

from beardyn_core.record.load_stream import LONGEST_NS
from beardyn_ros.frames import FRAME_ID
from beardyn_ros.parameters import NodeParameter

PARAMETERS = (
    NodeParameter(
        "scene", "cup_spall", "shipped scene by name, or path of a scene file: its operation is replayed"
    ),
    NodeParameter("csv", "", "CSV file of time, speed and force, replayed instead of the scene's operation"),
    NodeParameter(
        "duration", 0.0, "simulated time to replay, 0 for the scene's own", "s", minimum=0.0, maximum=86_399.0
    ),
    NodeParameter(
        "mode",
        "lockstep",
        "lockstep sends load/blocks; live sends load/wrench and load/shaft, stamped in time of the load",
        choices=("lockstep", "live"),
    ),
    NodeParameter("horizon", 1.0, "how far to stay ahead of the credit", "s", minimum=0.1, maximum=60.0),
    NodeParameter("block", 0.1, "load in one message", "s", minimum=0.001, maximum=LONGEST_NS * 1e-9 / 2),
    NodeParameter(
        "live_rate",
        200.0,
        "messages per wall second in live mode; the load passes a low-pass filter before it is sampled so: "
        "half-power point at a fifth of the rate, delay 1.68 / live_rate, 8 ms at 200 Hz",
        "Hz",
        minimum=1.0,
        maximum=1000.0,
    ),
    NodeParameter(
        "speed_factor",
        1.0,
        "simulated seconds per wall second in live mode, 0 means 1, as in the twin",
        minimum=0.0,
        maximum=100.0,
        live=True,
    ),
    NodeParameter(
        "position",
        0.0,
        "where in the scenario the replay begins; a change is a seek: stamps go on, the position moves with "
        "a cross-fade",
        "s",
        minimum=0.0,
        maximum=86_399.0,
        live=True,
    ),
    NodeParameter(
        "loop",
        False,
        "go on at the start of the scenario when it ends, with a cross-fade, until `loop` is set to false",
        live=True,
    ),
    NodeParameter("fade", 0.5, "cross-fade of a seek or a loop", "s", minimum=0.001, maximum=60.0),
    NodeParameter(
        "start_timeout", 120.0, "longest wait for a twin, 0 for ever", "s", minimum=0.0, maximum=1e6
    ),
    NodeParameter("exit_when_done", True, "end the process when everything is replayed and received"),
    FRAME_ID,
)
