"""The one topic table: name, type, QoS and content of every topic.

Names without a leading slash live under the namespace of an axlebox, `NAMESPACE` by default. The
same names and the same bytes go on the wire, into the file and to the viewer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.messages import CLOCK, DIAGNOSTICS, STRING, TIME
from beardyn_core.record.plot_values import FOLLOWER, MONITOR, VALUES, VECTOR

NAMESPACE = "/axlebox"
FRAME = "axlebox"

WRENCH = "geometry_msgs/msg/WrenchStamped"
TWIST = "geometry_msgs/msg/TwistStamped"
IMU = "sensor_msgs/msg/Imu"
TEMPERATURE = "sensor_msgs/msg/Temperature"
JOINTS = "sensor_msgs/msg/JointState"
TIME_REFERENCE = "sensor_msgs/msg/TimeReference"
POLYGON = "geometry_msgs/msg/PolygonStamped"


@dataclass(frozen=True)
class Topic:
    """One topic."""

    name: A[str, "relative to the namespace; absolute with a leading slash"]
    type: A[str, "ROS message type"]
    reliability: A[str, "``reliable`` or ``best_effort``"]
    durability: A[str, "``volatile`` or ``transient_local``"]
    depth: A[int, "messages kept for a slow reader; 0: all"]
    rate: A[str, "how often it is published"]
    content: A[str, "what it carries, units included"]

    def path(self, namespace: str = NAMESPACE) -> str:
        """Write the absolute name."""
        return self.name if self.name.startswith("/") else f"{namespace.rstrip('/')}/{self.name}"


_RELIABLE = ("reliable", "volatile")
_SENSOR = ("best_effort", "volatile")
_LATCHED = ("reliable", "transient_local")

_RESULT_RATES = {MONITOR: "as the monitor decides", FOLLOWER: "every stretch of 1.5 s"}

TOPICS: tuple[Topic, ...] = (
    Topic("force", WRENCH, *_RELIABLE, 200, "400 Hz", "force and moment of the rollers on the cup, N, N m"),
    Topic("force_waveform", CLOUD, *_RELIABLE, 50, "every 20 ms",
          "the same at full rate: sample, t, fx, fy, fz, mx, my, mz"),
    Topic("vibration", CLOUD, *_RELIABLE, 50, "every 20 ms",
          "specific force of the first accelerometer at full rate, m/s^2: sample, t, ax, ay, az; further "
          "accelerometers on vibration/<name>"),
    Topic("imu", IMU, *_SENSOR, 50, "400 Hz", "the first accelerometer decimated for plots; no orientation"),
    Topic("shaft", JOINTS, *_SENSOR, 50, "400 Hz", "tachometer: angle and speed of the shaft, rad, rad/s"),
    Topic("joint_states", JOINTS, *_SENSOR, 50, "200 Hz",
          "orbit angle and speed of cage_<row> and roller_<row>_<k>; joint shaft with the torque of the "
          "bearing on it as effort, N m"),
    Topic("bodies", CLOUD, *_SENSOR, 20, "every 20 ms, 200 snapshots a second, or snapshot_rate_Hz",
          "pose and twist of every body: sample, t, body, x, y, z, qx, qy, qz, qw, vx, vy, vz, wx, wy, wz"),
    Topic("contacts", CLOUD, *_SENSOR, 20, "every 20 ms, 200 snapshots a second, or snapshot_rate_Hz",
          "loaded contacts: sample, t, row, roller, kind (0 cup, 1 cone, 2 rib, 3 pocket), point, force on "
          "the roller, slip, film, largest load since the snapshot before (without one now: force 0)"),
    Topic("temperature", TEMPERATURE, *_RELIABLE, 50, "every 0.2 s, with the thermal effect",
          "temperature of one part, degrees Celsius; the frame names it: <frame>/axlebox, cup, cone, "
          "rollers, cages or grease"),
    Topic("truth", STRING, *_LATCHED, 1, "once",
          "JSON: scene, faults, fault frequencies, versions, description"),
    Topic("load/blocks", CLOUD, *_RELIABLE, 0, "as the horizon allows",
          "load on the journal: sample, t, fx..mz, shaft_speed, ux, uy, uz, float64; empty ends the stream"),
    Topic("load/truth", STRING, *_LATCHED, 1, "when it changes",
          "JSON: irregularity, events and seed of the load; which stamp stands where in the scenario; "
          "paused"),
    Topic("load/consumed", TIME, *_RELIABLE, 50, "every 0.2 s", "simulated time up to which load is used"),
    Topic("source_time", TIME_REFERENCE, *_LATCHED, 1, "every 0.2 s, with stamps of the load's source",
          "simulated time at a stamp: the offset between simulated time and the clock of the source"),
    Topic("load/wrench", WRENCH, *_RELIABLE, 200, "live", "one load on the journal, N, N m"),
    Topic("load/shaft", TWIST, *_RELIABLE, 200, "live", "one shaft speed, twist.angular.y, rad/s"),
    Topic("monitor/result", DIAGNOSTICS, *_RELIABLE, 50, "as the monitor decides",
          "verdict, lines and scores; parts not judged"),
    Topic("follower/estimate", STRING, *_RELIABLE, 50, "every stretch of 1.5 s",
          "JSON: health, condition, estimates with intervals, covariance, growth and forecast, as steps[] of "
          "`beardyn follow --json`"),
    Topic("follower/residual", STRING, *_RELIABLE, 50, "as the follower's twin runs",
          "JSON: third octaves measured and of the twin, as residual of `beardyn follow --json`"),
    *(Topic(value.topic, VECTOR, *_RELIABLE, 50, _RESULT_RATES[value.source], value.content)
      for value in VALUES),
    Topic("vibration_samples", POLYGON, *_RELIABLE, 50, "every block of vibration, when asked for",
          "ax, ay, az of every sample as x, y, z of a point, m/s^2, for plots of arrays"),
    Topic("/diagnostics", DIAGNOSTICS, *_RELIABLE, 50, "every 0.2 s",
          "real-time factor, status bits, energy residual, late and lost blocks"),
    Topic("/clock", CLOCK, *_RELIABLE, 10, "every 20 ms", "simulated time"),
)  # fmt: skip

_BY_NAME = {topic.name: topic for topic in TOPICS}


def topic(name: str) -> Topic:
    """Find the entry of the table; ``vibration/<name>`` is one of a further accelerometer.

    An absolute name is that of a topic in a namespace of its own, as several axleboxes in one file have.

    Raises
    ------
    KeyError
        The table has no such topic.
    """
    if name.startswith("/") and name not in _BY_NAME:
        space = namespace_of(name)
        if space is None:
            raise KeyError(name)
        return replace(topic(relative_name(name, space)), name=name)
    if name.startswith("vibration/"):
        return replace(_BY_NAME["vibration"], name=name)
    return _BY_NAME[name]


def relative_name(path: str, namespace: str = NAMESPACE) -> str:
    """Find the name that an absolute topic name has in the table."""
    prefix = namespace.rstrip("/") + "/"
    return path[len(prefix) :] if path.startswith(prefix) else path


def namespace_of(path: str) -> str | None:
    """Find the namespace of an absolute topic name that ends with a relative name of the table."""
    head, between, _ = path.rpartition("/vibration/")
    if between:
        return head
    names = (entry.name for entry in TOPICS if not entry.name.startswith("/"))
    ends = [name for name in names if path.endswith("/" + name)]
    # load/shaft ends with shaft too: the longer name is the right one.
    return path[: -len(max(ends, key=len)) - 1] if ends else None


def vibration_topic(sensor: int, names: tuple[str, ...]) -> str:
    """Name the topic of an accelerometer: ``vibration`` for the first, ``vibration/<name>`` for others."""
    return "vibration" if sensor == 0 else f"vibration/{names[sensor]}"
