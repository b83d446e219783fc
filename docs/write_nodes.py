"""Write docs/nodes.md from the tables that the nodes themselves use: ``python docs/write_nodes.py``."""

from __future__ import annotations

from pathlib import Path

from beardyn_core.record.plot_values import CODES
from beardyn_core.record.topics import TOPICS
from beardyn_ros.__main__ import PROGRAMS
from beardyn_ros.node_parameters import PARAMETERS
from beardyn_ros.runtime import EXIT_CODES
from beardyn_ros.typed_messages import PACKAGE, PREFIX, typed_message

PAGE = Path(__file__).with_name("nodes.md")
NODES = ("twin", "load", "recorder", "monitor", "follower", "viewer", "car_twin", "car_load", "car_recorder")

HEAD = """# Nodes

Written by `python docs/write_nodes.py` from the tables in the code.

Every node starts with `ros2 run beardyn NODE` or `python -m beardyn_ros NODE`, takes parameters as
`--ros-args -p NAME:=VALUE` or `--params-file FILE`, refuses unknown names and bad values with a
sentence, and ends cleanly on SIGINT and SIGTERM. In a file shared by several nodes (`/**:`) a name that a
node does not know is left to the others, with a warning; under the node's own name it is an error.
"""

SERVICES = """
Services of the twin, in its namespace: `pause` (`std_srvs/SetBool`), `step` (`std_srvs/Trigger`, one
block while paused, answered when it is published) and `reset` (`std_srvs/Trigger`, back to t = 0; a reset
starts a new recording). The twin is a lifecycle node: configure loads the scene and compiles off the
executor, activate solves the equilibrium under the first load and runs; with `autostart` it does both by
itself. All nodes tick by the wall clock, with `use_sim_time` on or off; while the twin is paused `/clock`
repeats the time at which it stands.

At a `speed_factor` above 0, and in live mode, a scene that leaves effects and tier open runs in its own tier
if that keeps the pace here, else in the best faster one: the twin simulates its beginning and asks for 1.3
times the pace, because messages, recorder and monitor take their part. The order is `full`, `quasistatic`
with coupled laminae (where rings bend and vibration is asked for), `quasistatic` as chosen for its accuracy,
`lumped`. What that costs is in the log, in the status and in `truth`: the measured speeds, the bounds of the
errors with those of the scene's tier, and by how much [third octaves of shipped
scenes](effects_auto.md#third-octaves-of-the-fast-tiers) were off.
Name a `tier` to have the same one on every machine; `car_twin` does not choose.

At a `speed_factor` above 0 the single samples of a block (`force`, `imu`, `shaft`, `joint_states`) go out
one after the other over the next 20 ms of simulated time, so that readers with sensor data QoS (depth 5) get
them all. At 0 they come block by block: such a reader needs a depth of a few hundred, or `reliable` with keep
all.

Where `simulation_interfaces` is installed, the twin offers the standard services of a simulator as well:

| service | what it does |
|---|---|
| `get_simulator_features` | lists what follows |
| `get_simulation_state` | stopped (not configured, ended or stopped), loading (compiling), playing, paused |
| `set_simulation_state` | playing, paused; stopped is pause and reset; quitting ends the process |
| `step_simulation` | `steps` blocks of 20 ms while paused; answers when they are done |
| `reset_simulation` | time and state together (scope 0, 3 or 255); one alone is unsupported |

### Its diagnostics

After REP-107 statuses are named in full, `axlebox/twin` in the namespace `/axlebox`, with the namespace as
`hardware_id`; `run_id` changes with every run and begins with `instance`, which a twin keeps from its start
to its end.

* `real_time_factor` is that of the whole node: simulated time over the time from load to a block that is
  handed over, with encoding and publishing, without waiting for the pace; `kernel_real_time_factor` is that
  of the simulation alone, `processor_time_per_simulated_time` counts all threads of the process.
* `pace` is simulated over wall time, without waiting for load, of the last second or so; in the last word of
  the whole run. `late_blocks` counts blocks that were published more than 40 ms after they were due,
  `last_late_time` is the simulated time of the last one, `worst_lag` the largest delay. The twin logs them at
  its end, `beardyn report` reads them from a recording.
* In lockstep up to 15 blocks (0.3 s) are computed before they are due, so that a machine that is busy for a
  moment delays none; a pause holds them, `step` publishes the next of them. Of a live load nothing is
  computed ahead.
* `tier_note` is there when the tier is a faster one than the scene's for the sake of the pace.
* `axlebox/lag` is a status of its own: by how much simulated time is behind the pace, WARN beyond 0.1 s of
  wall time.
* WARN goes again 5 s after the last refused or lost message; the counts stay.
* The last word, in state `finished`, `stopped` or `interrupted` (SIGINT, SIGTERM, lifecycle, reset), counts
  the messages of the run by topic: `messages force` and so on.

A second twin under the same full name refuses to start (exit code 2), and the first one warns while it
receives its messages; a recorder that receives two in turns closes its file and ends with 2. Of several twins
in one graph only one
may publish `/clock`; a twin that meets another publisher of it warns.

### What RViz shows

| topic | type | content |
|---|---|---|
| `robot_description` | `std_msgs/msg/String`, latched | URDF of box, cup, cone, cages and rollers |
| `/tf_static` | `tf2_msgs/msg/TFMessage`, latched | cup, sensors, parts, and the box in `parent_frame` |
| `/tf` | `tf2_msgs/msg/TFMessage` | with `joint_tf`: cone, cages and rollers, every 20 ms |

The frame of a box is its namespace, `axlebox` or `car/axle_1_left`, or `frame_id`: origin at the bearing
centre, x forwards, y left along the axle, z up (REP-103). Parts and sensors are below it: `axlebox/cone`,
`axlebox/axlebox_top`. Accelerometers are in the frame of their sensor (REP-145: specific force, +g on z at
rest, orientation and rate marked as not measured; `-r imu:=imu/data_raw` gives the topic its usual name),
everything else in that of the box. In RViz add RobotModel with the topic `/axlebox/robot_description`, and
set the fixed frame to that of the box or of the vehicle. Joints are called as in `joint_states`, so a
`robot_state_publisher` works in place of `joint_tf` (remap `joint_states`, no `frame_prefix`). Meshes are
STL files computed from the bearing's dimensions, in `$BEARDYN_CACHE_DIR/meshes` or `~/.cache/beardyn/meshes`:
RViz on another machine does not find them. The ROS 2 wheels have no tf2_msgs: without it the frames are
left out, the description is there.
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
not taken back: in lockstep a seek, a loop or a pause reaches the twin up to `horizon` later. `load/truth` has
the place of each stamp, before the load that it is about comes: `replay.passages` lists, for each
passage, its first `sample` and `stamp_s`, its `position_s` there, and for how long (`fade_s`) the passage
before it still fades out. At the stamp t of a passage the position is `position_s + t - stamp_s`.

A pause is also published on `load/truth`, and the twin then waits in either mode: simulated time stands
still, neither `load_timeout` nor `max_age` runs, and the age of a live load counts anew when it goes on. When
a source falls silent without announcing a pause, or dies while paused (Fast DDS reports it within 10 s), the
load is lost as ever. Reset of the twin starts the stream again at sample 0 and the first stamp.

### A recording in its place

Any node may send the load. A recording of a lockstep run replays to the same bits:

```
ros2 bag play run.mcap --delay 1 --topics /axlebox/load/blocks /axlebox/load/truth
```

Without the delay the player sends its first block before the twin has found it. A stream begins at sample
0: when that is missing the twin names the samples, waits for `load_timeout` in case they are sent
again, and ends with exit code 4. `join:=true` takes a stream from where it stands.

A bag does not wait for credit: with `--rate` it may run ahead of the twin by `load_queue` seconds or
`load_queue_size` MB, beyond which the twin stops with a message.
"""

CAR = """
## Several boxes

`ros2 launch beardyn car.launch.py scene:=bogie` runs the axleboxes of the scene by
[`axleboxes`](rail.md#several-axleboxes-at-once), as `beardyn simulate bogie` does: which there are, how far
apart, which are faulty, with the same loads. `car_twin` has the twins of all in one process, `car_load`
their loads, `car_recorder` records them into one file, each under its namespace: `beardyn report`, `monitor`
and `view` take a box of it as `--box car/axle_2_left`. `boxes:="axle_1_left axle_1_right"` chooses some of
them; what the scene sets is no parameter then, and is refused as one. With `pictures: false` the twins
publish no `bodies` and `contacts`. A `twin` or `load` node refuses such a scene; a twin with the parameter
`box` is that box of the scene.

A scene without `axleboxes` is that of every box of a car: `ros2 launch beardyn car.launch.py` starts a twin
in each of `/car/axle_1_left` to `/car/axle_4_right`, with one load (`car_load`) and one recorder
(`car_recorder`); `--show-args` lists its arguments. The twins are of tier `lumped` unless `tier:=` is given;
`faulty_box:=axle_2_left faulty_scene:=cup_spall` gives one of them a spall. Each has its `box`: right ones
are mirrored. Every box has a file of its own, `car_<box>.mcap`. `car_twin` has these in
one process, too, the defects of the scene in those of `faulty`; with it go `car_load` and `car_recorder`:
`ros2 run beardyn car_twin --ros-args -p scene:=cup_spall -p tier:=lumped -p faulty:=axle_2_left`. The first
twin publishes `/clock`. `monitor:=true` and `follower:=true` start a monitor and a follower of every box
next to its twin, each in its namespace, with `bearing:=` as their bearing data; the recorder keeps their
results.

`ros2 launch beardyn train.launch.py cars:=2` starts several such cars, `/train/car_1` and so on, each with a
load and recordings of its own (`train_car_1.mcap`, or `train_car_1_<box>.mcap`) and at the pace of the clock;
`faulty_box:=car_2/axle_2_left` names a box of one of them. Each car rides as if it were the first of the
train; the first publishes `/clock` (`publish_clock` of the others is false).

The scene is the run of the first wheel. A wheel further back comes over the same track later, by its
distance over the speed: axle 2 by `axle_distance`, axle 3 by `bogie_distance`, axle 4 by both. All shafts
turn at the present speed of the train. The right rail is another one of the same kind (the next seed), and
curves turn the other way for the right boxes; loads that are given (constant, stepped, CSV) are the same
left and right. Defects of the wheel are on one wheel, `wheel_defects_on`, or on those of the faulty boxes.
All boxes have axes of the same directions, so that row 0, inboard on the left, is outboard on the right.
`load/truth` of each box states how far behind it is. No box gets load further ahead than `horizon` of the
slowest: they stay together, and the `/clock` of one is right for all. Each box has the topics and services
of a load node of its own (`/car/axle_1_left/load/blocks`); `/car/load/pause` holds all of them.

What ends first ends the others in order:

| first | then |
|---|---|
| the load, all sent | the twins compute what they have and end, then the recorder closes its files |
| a twin or the load, by failure | load and twins are interrupted, then the recorder closes its files |
| the recorder | load and twins are interrupted: they do not go on unrecorded |
| Ctrl-C | everything is interrupted, files are closed |
"""

RECORDER = """
The last word of the twin on `/diagnostics` states how many messages of every topic it has published (values
`messages TOPIC`). The recorder waits for what is still on its way, then reports which topics lack how many,
and ends with 5; `beardyn report` finds the same in the file. A twin that is killed has no last word: the file
states that it vanished. A recorder that joins a run ends with 0 when nothing was lost since: it states from
when it has recorded (`recorded_from`, s) and how much was before.

Every node takes a message only if it is what its topic promises and comes from the publisher that it follows:
the node that the topic is named for, where there is one, else the first that speaks; another one follows when
that has gone. What is refused is counted (`refused: TOPIC` and `refused_messages` in the diagnostic of every
node; in that of the twin by reason) and not recorded. A `truth` names a file and chooses no folder.
`python -m evidence.ros.fuzz --messages 10000` publishes hostile messages on every topic during a run of all
nodes and reports whether anything ended, split or is missing: nothing in three runs of 10 000 of them at half
of real time. In real time all six nodes and the sender are more than two cores can carry: receive buffers
overflow, and a recorder that falls behind lacks up to two thirds of the messages, reports that and ends with
5.

A disk that stalls is waited for in the background, up to 128 MB.

With `max_file_size` or `max_file_duration` a run becomes a folder as rosbag2 makes it: each file is whole in
itself and names the next one, `metadata.yaml` lists them. `beardyn report`, `view`, `export` and `monitor`
take the folder or its `metadata.yaml` in the place of a file, and so does `ros2 bag`.

### Fast DDS

Nodes that no one has given a Fast DDS profile (`FASTDDS_DEFAULT_PROFILES_FILE`) take the one of the package,
in a sourced ROS too: without it what was lost on the way is sent again up to 3 s later. A profile of your own
should have a heartbeat period of 20 ms and as long a `nack_supression_duration`: its default, 0, wakes a
thread for every sample. The twin waits for its readers in runs faster than real time; up to
real time it keeps ten seconds for a slow one.

The profile has one transport, UDPv4, also between processes of one machine. With shared memory, the default
of Fast DDS, a process that is killed (`kill -9`, out of memory) while it holds a lock there stops the others:
the twin stands still for seconds, and after fifteen killed recorders on a busy machine it has ended for want
of load. With UDP 100 killed recorders lost 0.20 s each on average and 0.42 s at worst, with no gaps
(`python -m evidence.ros.kills`: a twin without physics at speed factor 1, two idle cores); on cores with
other work 3.1 s at worst, and one file had two gaps. Both cost the same processor time. Nodes with default
settings (`ros2 topic`, RViz, rosbag2) meet these over UDP and need nothing; among themselves they
go on with shared memory. With
`ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST` rmw_fastrtps adds shared memory to any profile: to keep nodes on one
machine without it, give them `fastdds_local_profile.xml` of the package and `SYSTEM_DEFAULT`, as the demo
does. A node that gets no processor for a second loses what its socket cannot hold: the kernel gives it twice
`net.core.rmem_max` at most, 16 MB are asked for. With 8 MB a recorder on two cores with ten times their work
lost 5000 datagrams in a quarter of an hour; all were sent again, and none is missing in the file. A larger
`rmem_max` spares such repetitions, in runs faster than real time too.
"""

PROTOCOL = """
## Load protocol

`load/blocks` is reliable and keeps all. The load node stays within `horizon` of the simulated time that the
twin repeats on `load/consumed` every 0.2 s; an empty block ends the stream. A twin looks ahead: samples that
are evenly spaced by at most 11 ms are interpolated without images of their rate, which takes 30 of them on
either side, 15 ms at 2 kHz; [rail.md](rail.md#between-the-samples) lists what stays linear. In lockstep a
block is computed only when the 30 samples after its end have arrived, or the end of the stream: the signals
are the same to the last bit at any speed. Who sends in step with `load/consumed` must stay one block of 20
ms and 30 samples ahead of it; the load node adds these to its horizon. Messages with NaN, out of order, with
gaps or absurd numbers, from the far future or in another frame than `frame_id` (none is taken too) are
counted and refused in `/diagnostics`. Every sample has a running number: a loss shows as a gap and never as
a guess. A refused block may be sent again; when the stream ends with one of its blocks still missing the
twin ends with exit code 4.

In `live` mode force and speed pass a Bessel filter of order 4 before they are sampled every 20 ms: above
`live_bandwidth` next to nothing is folded into the signal, below it everything is 0.336 / `live_bandwidth`
late. A smooth line through these values, whose images of 50 Hz are 85 dB down up to 10 Hz and 35 dB at 15
Hz, takes another 80 ms, and the twin's look-ahead 20 ms: 134 ms in all at 10 Hz. Stamps may be of any clock
that runs forward. A stamp that does not follow the one before it, or lies far in the future, is refused;
after five in a row that follow each other the source has set its clock, and the load goes on.

### Time of the train

In `live` mode all outputs carry the clock of the load (parameter `stamps`): force, vibration, estimate and
diagnostics have the stamp of the load that they answer, delay included, so that twin and measured
accelerometer pair by stamp. The clock is read from `load/wrench`, by the least late message of the last 2 s;
what remains is the latency of the quickest message and half the spacing of messages. Sample numbers begin at
0 as ever. `source_time` (`sensor_msgs/TimeReference`, latched, every 0.2 s, recorded) gives the offset:
`header.stamp` is a stamp, `time_ref` the simulated time at it; `stamps_ahead_of_simulated_time_ns` of the
twin's status is the same number. `truth` has `begin_ns`, a stamp that no sample of the run is earlier than.

| the clock of the load | what stamps do |
|---|---|
| runs faster or slower, up to 1 ms a second | follow it, by 20 us a block at most |
| is set forward by more than 50 ms, or the twin was paused | leap with it, once; the status reports it |
| is set back by 50 ms to 10 s | the run is held until the clock shows a new time: no stamp comes twice |
| is set back by more | a new run begins, with a new `run_id` and a recording of its own |
| runs at another pace than `speed_factor` | go on at the pace of the twin; the status warns |
| differs between `load/wrench` and `load/shaft` by more than 0.1 s | follow `load/wrench`; the status warns |

Monitor and follower pair vibration and shaft by stamp: where the two have been more than 0.5 s apart for 5 s,
as with a sensor whose clock drifts, their status warns and states the distance.

`/clock` stays silent then, unless `publish_clock` is true: the train has a clock. A twin that is late
(status `axlebox/lag`) answers load that is younger than its stamps, by as much as it lags. In `lockstep`
stamps count from 0 by default; with `stamps:=source` they are those of `load/blocks`, exactly.
"""


VALUES = """
### Numbers for plots

Each result of the monitor and of the follower comes on `values/NAME` as well, before the result itself and
with its stamp: x is the value in SI, y and z are the lower and the upper end of its interval. The table names
unit and interval. NaN is a number that is not known, and never 0: `spall_width` with NaN, 0.003, NaN is a
spall of at least 3 mm. The last word of a node repeats an earlier result and brings no numbers. The parameter
`values` of either node leaves them out. Verdict, health and condition are codes; from 10 on there is a fault:

| code | verdict, health or condition |
|---|---|
"""

TYPED_HEAD = """
### Typed messages

Where the package `beardyn_msgs` is built and sourced, the nodes publish these topics once more, with messages
that a program reads without a parser of its own:

| topic | type | content of |
|---|---|---|
"""

TYPED_TAIL = """
The package is in [interfaces](../interfaces/beardyn_msgs/package.xml) and is built with colcon next to the
nodes; the comments in its messages name every unit. A message has the stamp, the frame and the numbers of
the topic next to it. Without a subscriber nothing is converted; `typed:=false` leaves the topics out. The
recorder does not subscribe to them: the recording has their content already. Both waveforms together take the
twin 0.004 s of processor time a simulated second to convert and encode when they are read.

```
colcon build --base-paths src src/beardyn/interfaces
```

### Every sample of a waveform

With `waveform:=true` the monitor publishes each block of `vibration` as `vibration_samples` as well, also
that of a real axlebox: a `geometry_msgs/PolygonStamped` whose points are ax, ay, az of one sample after the
other. Foxglove plots such an array; [viewers.md](viewers.md#every-sample-of-a-waveform) covers the others.
"""

KEPT = """
### How long topics are kept

Until version 1.0 topics may change with a minor version, as [quality.md](quality.md) states, and only as in
this table.

| topic | replaced by | kept |
|---|---|---|
| `monitor/result` | nothing: `values/` has no reasons, parts and stages | without an end |
| `follower/estimate` (JSON) | `typed/follower/estimate`; `values/` for plots | until 1.0 at least |
| `follower/residual` (JSON) | nothing | until 1.0 |
| `truth`, `load/truth` (JSON) | nothing: their content differs from scene to scene | without an end |
| `vibration`, `force_waveform`, `load/blocks` | nothing | without an end |
| `imu` | nothing: decimated vibration for tools without arrays | without an end |
| `values/NAME`, `vibration_samples`, `typed/` | nothing: new in 0.1 | until 1.0 at least |

A text on any topic has up to 4 MB; a longer one is refused and counted. Texts do not grow with the run:
`truth` of a shipped scene has 60 kB, `load/truth` names the last 100 passages and how many there were.
"""


LAUNCHES = """The launch files end with 1 when one of their nodes has ended with another code than 0;
SIGINT is no failure. When the load is replayed all nodes end with 0, but for the viewer, which stays open.
`use_sim_time:=true` lets the clocks of all nodes follow `/clock`. They stop nothing that another launch file,
which includes them, has started.
"""


def parameter_rows(node: str) -> list[str]:
    """Table rows of one node's parameters."""
    rows = []
    for parameter in PARAMETERS[node]:
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
    lines += [LAUNCHES]
    for node in NODES:
        if node == "car_twin":
            lines.append(CAR)
        lines += [f"## {node}", "", f"{PROGRAMS[node][1].capitalize()}.", ""]
        lines += ["| parameter | type | default | allowed | meaning |", "|---|---|---|---|---|"]
        lines += [*parameter_rows(node), ""]
        lines += {"twin": [SERVICES], "load": [LOAD_SERVICES], "recorder": [RECORDER]}.get(node, [])
    lines += [PROTOCOL, "## Topics", "", "| topic | type | QoS | rate | content |", "|---|---|---|---|---|"]
    for topic in TOPICS:
        quality = topic.reliability + (", latched" if topic.durability == "transient_local" else "")
        lines.append(f"| `{topic.name}` | `{topic.type}` | {quality} | {topic.rate} | {topic.content} |")
    lines += [VALUES[:-1], *(f"| {code} | `{name}` |" for name, code in CODES.items()), TYPED_HEAD[:-1]]
    for topic in TOPICS:
        if found := typed_message(topic.name):
            lines.append(f"| `{PREFIX}{topic.name}` | `{PACKAGE}/msg/{found.type_name}` | `{topic.name}` |")
    lines += [TYPED_TAIL[:-1], KEPT[:-1]]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
