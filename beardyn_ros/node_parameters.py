"""Parameters of every node, as `docs/nodes.md` lists them; `parameters` declares and checks them.

They are in a file of their own because the nodes of several axleboxes have those of one box, but for what
each box has of its own, and because help and page need them without the nodes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from beardyn_core.record.load_stream import LONGEST_NS
from beardyn_core.scene.tier import TIER_NAMES
from beardyn_ros.parameters import NodeParameter
from beardyn_ros.rig import CAR, SCENE_OWN
from beardyn_ros.source_time import STAMPS

FRAME_ID = NodeParameter(
    "frame_id",
    "",
    "frame of the axlebox, origin at the bearing centre; empty: the namespace, so that several boxes differ",
)
PARENT = NodeParameter(
    "parent_frame", "", "frame that the axlebox stands in, a vehicle's for one; empty: in none"
)
POSE = NodeParameter("pose_in_parent", "", "place there: x y z roll pitch yaw, m and rad; empty: the origin")
JOINT_TF = NodeParameter(
    "joint_tf",
    False,
    "publish /tf of cone, cages and rollers every 20 ms, where no robot_state_publisher does it",
)
BOX = NodeParameter(
    "box",
    "",
    "which of the scene's axleboxes this is, axle_<number>_<left or right>; of a scene without them, of the "
    "four axles of a car: a right one is mirrored, each has another bearing of the lot and other noise; "
    "'': the one box of the scene, a left one",
)
TYPED = NodeParameter(
    "typed", True, "publish typed/<topic> as well, where beardyn_msgs is built and sourced; else nothing"
)
TWIN = (
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
        "in lockstep the results do not depend on it, unless the scene leaves effects and tier open: above 0 "
        "(live: always) a faster tier is taken where this machine does not keep the pace otherwise",
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
        "without images of the 50 Hz (85 dB down up to 10 Hz) adds 100 ms",
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
    NodeParameter(
        "stamps",
        "auto",
        "clock of all stamps: source, that of the load (in live mode of load/wrench, less the delay of "
        "filter and interpolation), with the offset on source_time; simulated, from 0 on; auto: source in "
        "live mode, simulated in lockstep",
        choices=STAMPS,
    ),
    NodeParameter(
        "publish_clock",
        "auto",
        "publish /clock; one twin of several; auto: with stamps that are simulated time, for a train has a "
        "clock",
        choices=("auto", "true", "false"),
    ),
    TYPED,
    FRAME_ID,
    PARENT,
    POSE,
    JOINT_TF,
)

LOAD = (
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
    NodeParameter(
        "wait_for",
        "",
        "nodes of the namespace that the replay waits for, 30 s at most, such as recorder monitor; empty: "
        "only for those that are seen when the twin is",
    ),
    NodeParameter("exit_when_done", True, "end the process when everything is replayed and received"),
    TYPED,
    FRAME_ID,
)

RECORDER = (
    NodeParameter(
        "output",
        "",
        "file to write; further runs get _2, _3; empty: <scene>_<date>.mcap here",
    ),
    NodeParameter("replace", False, "replace the file when it exists, instead of refusing to start"),
    NodeParameter(
        "max_file_size",
        0.0,
        "largest file, at least 1; a run is then a folder, named as output without its ending, with files "
        "NAME_0.mcap, NAME_1.mcap and metadata.yaml; 0: no limit",
        "MB",
        minimum=0.0,
        maximum=1e6,
    ),
    NodeParameter(
        "max_file_duration",
        0.0,
        "longest simulated time in a file, else as max_file_size; 0: no limit",
        "s",
        minimum=0.0,
        maximum=1e6,
    ),
    NodeParameter("exit_when_done", True, "close the file and end the process when the twin has ended"),
    NodeParameter(
        "start_timeout", 120.0, "longest wait for a twin, 0 for ever", "s", minimum=0.0, maximum=1e6
    ),
)

BEARING = NodeParameter(
    "bearing", "HS130x230", "bearing data: shipped bearing by name, or path of a bearing file"
)
MONITORED = NodeParameter(
    "bearing",
    "HS130x230",
    "bearing data: shipped bearing or designation of the catalogue, or path of a file of bearing data",
)
FACTORS = (
    NodeParameter(
        "bpfo",
        0.0,
        "maker's factor of the outer ring, and so on; those given stand in place of bearing; 0: not given",
        minimum=0.0,
    ),
    NodeParameter("bpfi", 0.0, "maker's factor of the inner ring; 0: not given", minimum=0.0),
    NodeParameter(
        "bsf",
        0.0,
        "maker's factor of a rolling element, not twice it; 0: not given",
        minimum=0.0,
    ),
    NodeParameter("ftf", 0.0, "maker's factor of the cage; 0: not given", minimum=0.0),
    NodeParameter(
        "roller_count", 0, "rolling elements of one row, with factors; 0: not given", minimum=0, maximum=200
    ),
)
VALUES = NodeParameter(
    "values", True, "publish the numbers of each result on values/<name> for plots, next to the result itself"
)
WAVEFORM = NodeParameter(
    "waveform",
    False,
    "publish every sample of vibration on vibration_samples as well, an array that Foxglove plots",
)
EXIT_WHEN_DONE = NodeParameter("exit_when_done", True, "sum up and end the process when the twin has ended")
MONITOR = (
    MONITORED,
    *FACTORS,
    NodeParameter(
        "algorithm",
        "",
        "module:function in place of the reference chain, a beardyn_core.monitor.chain.Chain for one",
    ),
    NodeParameter(
        "interval",
        2.0,
        "time between two analyses, each of the last 60 revolutions; with 2 s the monitor takes at most a "
        "third of the processor time of a twin in the tier quasistatic",
        "s",
        minimum=0.1,
        maximum=3600.0,
    ),
    NodeParameter(
        "warm",
        90.0,
        "temperature of the axlebox from which it is called warm; assumed, bd.heat_interval gives that of a "
        "scene, in kelvin",
        "degC",
        minimum=0.0,
        maximum=300.0,
    ),
    NodeParameter(
        "hot", 120.0, "and from which it is a hot box; assumed", "degC", minimum=0.0, maximum=300.0
    ),
    VALUES,
    WAVEFORM,
    TYPED,
    EXIT_WHEN_DONE,
)

FOLLOWER = (
    BEARING,
    NodeParameter(
        "estimator",
        "",
        "file of `beardyn train`; empty: the own or the shipped one of the bearing and of the axes that come",
    ),
    NodeParameter("mileage", 0.0, "of the bearing so far", "km", minimum=0.0, maximum=1e8),
    NodeParameter(
        "wheel_diameter", 920.0, "running diameter of the wheel", "mm", minimum=300.0, maximum=1500.0
    ),
    NodeParameter(
        "load",
        "",
        "vertical load on this journal that is known, VALUE:UNCERTAINTY such as 70kN:3kN or 70kN:5%; topic "
        "or topic:UNCERTAINTY%: that of load/blocks or load/wrench; empty: not known",
    ),
    NodeParameter(
        "load_sensor",
        "",
        "sensors that give the load, as of beardyn estimate --load-sensor, ; between; empty: none",
    ),
    NodeParameter(
        "axle_load", "", "EMPTY:FULL, axle loads of the vehicle, against which the load is checked", "t"
    ),
    NodeParameter("twin", "", "healthy scene of this axlebox on its track, a twin next to it; empty: none"),
    NodeParameter("twin_tier", "quasistatic", "of that twin", choices=("lumped", "quasistatic")),
    NodeParameter(
        "twin_period",
        6.0,
        "time from one comparison with the twin to the next",
        "s",
        minimum=1.0,
        maximum=1e6,
    ),
    VALUES,
    TYPED,
    EXIT_WHEN_DONE,
)

VIEWER = (
    NodeParameter("target", "window", "where to draw", choices=("window", "web", "file")),
    NodeParameter("output", "run.rrd", "file for target file"),
    NodeParameter("port", 0, "port of the page for target web, 0 for a free one", minimum=0, maximum=65535),
    NodeParameter("exit_when_done", False, "end the process when the twin has ended"),
)

# of the nodes of several axleboxes
BOXES = NodeParameter(
    "boxes",
    "",
    "some of the axleboxes, each a namespace below that of this node: axle_<number>_<left or right>, axle 1 "
    "leads; '': all axleboxes of the scene, or all eight of a car",
)
PUBLISH_CLOCK = "publish_clock"
# every box has frame and place of its own; the first one publishes the clock for all
OWN = (FRAME_ID.name, BOX.name, PUBLISH_CLOCK, PARENT.name, POSE.name)
TWIN_OF_A_BOX = tuple(each for each in TWIN if each.name not in OWN)
CAR_TWIN = (
    BOXES,
    NodeParameter(
        "faulty",
        "",
        "boxes that have the defects of the scene, blanks or commas in between; '': those of the scene's "
        "axleboxes, or none",
    ),
    replace(PARENT, description="frame that the axleboxes stand in, each in its place; empty: the namespace"),
    NodeParameter(
        PUBLISH_CLOCK,
        "auto",
        "publish /clock, by the first box; one car of several; auto: as of a twin",
        choices=("auto", "true", "false"),
    ),
    *TWIN_OF_A_BOX,
)

LOAD_OF_A_BOX = tuple(each for each in LOAD if each.name != FRAME_ID.name)
CAR_LOAD = (
    BOXES,
    NodeParameter(
        "axle_distance",
        CAR.axle_distance,
        "between the axles of a bogie; of a scene with axleboxes it is theirs",
        "m",
        minimum=0.0,
        maximum=5.0,
    ),
    NodeParameter(
        "bogie_distance",
        CAR.bogie_distance,
        "between the centres of the bogies; of a scene with axleboxes it is theirs",
        "m",
        minimum=0.0,
        maximum=30.0,
    ),
    NodeParameter(
        "wheel_defects_on",
        "axle_1_left",
        "box whose wheel has the defects of the scene's wheel; '' for none; of a scene with axleboxes: the "
        "faulty ones",
    ),
    *LOAD_OF_A_BOX,
)

CAR_RECORDER = (
    BOXES,
    NodeParameter(
        "scene",
        "",
        "scene of the boxes: one with axleboxes is recorded into one file, each box under its namespace, or, "
        "with max_file_size or max_file_duration, a folder each; '' or another scene: a file each",
    ),
    *RECORDER,
)

PARAMETERS: Mapping[str, tuple[NodeParameter, ...]] = {
    "twin": TWIN,
    "load": LOAD,
    "recorder": RECORDER,
    "monitor": MONITOR,
    "follower": FOLLOWER,
    "viewer": VIEWER,
    "car_twin": CAR_TWIN,
    "car_load": CAR_LOAD,
    "car_recorder": CAR_RECORDER,
}
