"""Parameters of the twin node."""

from __future__ import annotations

from beardyn_core.scene.tier import TIER_NAMES
from beardyn_ros.frames import FRAME_ID
from beardyn_ros.parameters import NodeParameter
from beardyn_ros.robot_description import DESCRIPTION_PARAMETERS
from beardyn_ros.run_state import SCENE_OWN

BOX = NodeParameter(
    "box",
    "",
    "which of the scene's axleboxes this is, axle_<number>_<left or right>; of a scene without them, of the "
    "four axles of a car: a right one is mirrored, each has another bearing of the lot and other noise; "
    "'': the one box of the scene, a left one",
)
PARAMETERS = (
    NodeParameter("scene", "cup_spall", "shipped scene by name, or path of a scene file"),
    BOX,
    NodeParameter(
        "tier",
        SCENE_OWN,
        "how much of the bearing moves by itself: lumped and quasistatic are fast; scene: the scene's own",
        choices=(SCENE_OWN, *TIER_NAMES),
    ),
    NodeParameter(
        "effects",
        SCENE_OWN,
        "set or file of effects, or auto; scene: the scene's own, chosen for its operation if it names none",
    ),
    NodeParameter(
        "mode",
        "lockstep",
        "lockstep waits for load/blocks; live holds the last load/wrench and load/shaft behind a filter, "
        "their stamps may be of any one clock as long as they increase",
        choices=("lockstep", "live"),
    ),
    NodeParameter(
        "speed_factor",
        0.0,
        "simulated seconds per wall second, 1 is real time, 0 is as fast as it goes (in live mode: 1); "
        "in lockstep the results do not depend on it",
        minimum=0.0,
        maximum=1000.0,
        live=True,
    ),
    NodeParameter("autostart", True, "configure and activate at once, without a lifecycle manager"),
    NodeParameter(
        "exit_when_done", True, "end the process when the load stream has ended or the run has stopped"
    ),
    NodeParameter(
        "start_timeout", 120.0, "longest wait for the first load, 0 for ever", "s", minimum=0.0, maximum=1e6
    ),
    NodeParameter(
        "load_timeout",
        10.0,
        "longest wait for load that stopped coming in lockstep, 0 for ever",
        "s",
        minimum=0.0,
        maximum=1e6,
    ),
    NodeParameter(
        "max_age", 0.5, "oldest load that the live mode may hold", "s", minimum=0.02, maximum=3600.0
    ),
    NodeParameter(
        "live_bandwidth",
        10.0,
        "live load passes a low-pass filter before it is sampled every 20 ms: its half-power point; the "
        "delay is 0.336 / live_bandwidth, 34 ms at 10 Hz; 40 Hz is damped by 34 dB then; interpolation "
        "without images of the 50 Hz (85 dB down up to 10 Hz) adds 80 ms",
        "Hz",
        minimum=0.1,
        maximum=15.0,
    ),
    NodeParameter(
        "join",
        False,
        "take a load stream from where it stands; otherwise a stream whose sample 0 is missing is refused",
    ),
    NodeParameter(
        "load_queue",
        120.0,
        "load that may wait; more is an error that ends the run",
        "s",
        minimum=0.1,
        maximum=3600.0,
    ),
    NodeParameter(
        "load_queue_size",
        256.0,
        "memory that waiting load may take, 88 bytes a sample",
        "MB",
        minimum=0.1,
        maximum=16_384.0,
    ),
    NodeParameter("publish_clock", True, "publish /clock; one twin of several"),
    FRAME_ID,
    *DESCRIPTION_PARAMETERS,
)
