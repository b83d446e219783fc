"""A run as named arrays: the same names and shapes from memory, from a file and from live messages."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.monitor.streaming import MonitorInput, measured_axes
from beardyn_core.record import arrays
from beardyn_core.record.encoding import ACCELERATION_AXES
from beardyn_core.record.topics import NAMESPACE, vibration_topic
from beardyn_core.sensors.labels import flat_labels, load_labels

if TYPE_CHECKING:
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.record.block_source import BlockSource
    from beardyn_core.record.description import RunDescription
    from beardyn_core.record.message_source import MessageSource
    from beardyn_core.sensors.block import Block
    from beardyn_core.sensors.summary import RunSummary

Part = TypeVar("Part")

USUAL_BOX = NAMESPACE.strip("/")
MONITOR_PART = 512  # vibration samples that a monitor gets at a time
_NONE = np.zeros(0)
_SILENCE = arrays.no_signal(ACCELERATION_AXES, "m/s^2")


class Run:
    """One run of a bearing: named arrays, SI, the same from memory, from a file or from live blocks.

    The axes are x forward, y left along the axle, z up. Arrays that nobody asks for are not made. What a
    recording lacks is there with no samples.

    Parameters
    ----------
    path : Path, optional
        Of the recording; ``None`` for a run in memory.
    complete : bool
        Whether a file was closed properly.
    problem : str
        Where and why reading stopped; empty when complete.
    status : str or None
        How the run ended: ``complete`` as asked, else a sentence; ``None`` when the file has none.
    scene_text : str
        Resolved YAML of the scene.
    summary : callable, optional
        Gives the summary of the simulation; otherwise it is made from the arrays.
    malformed : mapping of str to int, optional
        Messages of a file that were left out because they are not what their topic promises, by topic.
    measured : mapping, optional
        Of a run that was measured and not simulated: files, channels, units, speed, bearing data; see
        docs/measured.md. Empty for a simulated one.
    boxes : mapping, optional
        Of a run of several axleboxes: every one by its name.
    box : str
        Name of this one among them; empty where it is alone.
    """

    def __init__(
        self,
        source: BlockSource | MessageSource,
        description: RunDescription | None,
        *,
        path: Path | None = None,
        complete: bool = True,
        problem: str = "",
        status: str | None = None,
        scene_text: str = "",
        summary: Callable[[], RunSummary] | None = None,
        malformed: Mapping[str, int] | None = None,
        measured: Mapping[str, Any] | None = None,
        boxes: Mapping[str, Run] | None = None,
        box: str = "",
    ) -> None:
        self._source = source
        self.description = description
        self.path = path
        self.complete = complete
        self.problem = problem
        self.status = status
        self.scene_text = scene_text
        self.malformed = dict(malformed or {})
        self.measured = dict(measured or {})
        self._summary = summary
        self._boxes = boxes
        self.box = box

    @property
    def boxes(self) -> Mapping[str, Run]:
        """Every axlebox of the run or recording by its name; this one alone where there is one."""
        return self._boxes or {USUAL_BOX: self}

    @classmethod
    def of_blocks(
        cls,
        blocks: Iterable[Block],
        description: RunDescription | None = None,
        status: str | None = None,
        summary: Callable[[], RunSummary] | None = None,
        boxes: Mapping[str, Run] | None = None,
        box: str = "",
    ) -> Run:
        """Make a run of blocks, such as `beardyn_core.blocks` or a live twin gives.

        Blocks hold signals and no word on their scene: `truth` and `labels` are empty without a description,
        which ``RunDescription.of(scene, twin.truth(), twin.body_names, load)`` makes.

        Parameters
        ----------
        blocks : iterable of Block
            In the order of time.
        description : RunDescription, optional
            Gives names of sensors and bodies, the truth, and the load if it is known.
        status : str, optional
            How the run ended.
        summary : callable, optional
            Gives the summary of the simulation.
        boxes, box : optional
            See `Run`.
        """
        from beardyn_core.record.block_source import BlockSource
        from beardyn_core.record.message_source import MessageSource

        given = tuple(blocks)
        source = BlockSource(given, description) if given else MessageSource({}, description)
        text = "" if description is None else description.scene_text
        return cls(source, description, status=status, scene_text=text, summary=summary, boxes=boxes, box=box)

    @cached_property
    def force(self) -> arrays.Signal:
        """Force and moment of the rollers on the cup at 400 Hz, values [sample, 6], [N, N m]."""
        return self._take(self._source.force)

    @cached_property
    def force_waveform(self) -> arrays.Signal:
        """Force and moment of the rollers on the cup, values [sample, 6], [N, N m].

        At 25.6 kHz, or the slower rate of the sensors.
        """
        return self._take(self._source.force_waveform)

    @cached_property
    def sensors(self) -> dict[str, arrays.Signal]:
        """Specific force that each accelerometer reads, by its name, values [sample, 3], [m/s^2]."""
        return self._take(self._source.sensors)

    @property
    def vibration(self) -> arrays.Signal:
        """Specific force that the first accelerometer reads, values [sample, 3], [m/s^2]; +g on z at rest."""
        return self.sensors.get(self._sensor_names[0], _SILENCE) if self._sensor_names else _SILENCE

    @property
    def sensor_topics(self) -> dict[str, arrays.Signal]:
        """`sensors` by the topic that each is recorded on."""
        names = self._sensor_names
        return {vibration_topic(names.index(name), names): signal for name, signal in self.sensors.items()}

    @property
    def _sensor_names(self) -> tuple[str, ...]:
        return tuple(self.sensors) if self.description is None else self.description.sensor_names

    @cached_property
    def specific_force(self) -> arrays.Signal:
        """Specific force at the first accelerometer, decimated to 400 Hz, values [sample, 3], [m/s^2]."""
        return self._take(self._source.specific_force)

    @cached_property
    def shaft(self) -> arrays.Turning:
        """Angle and speed of the shaft at 400 Hz, each [sample]."""
        return self._take(self._source.shaft)

    @cached_property
    def torque(self) -> arrays.Signal:
        """Torque of the bearing on the shaft at 200 Hz, values [sample], [N m]."""
        return self._take(self._source.torque)

    @cached_property
    def cages(self) -> arrays.Turning:
        """Orbit angle and speed of both cages at 200 Hz, each [sample, row]."""
        return self._take(self._source.cages)

    @cached_property
    def rollers(self) -> arrays.Turning:
        """Orbit angle and speed of all rollers at 200 Hz, each [sample, row, roller]."""
        return self._take(self._source.rollers)

    @cached_property
    def bodies(self) -> arrays.Bodies:
        """Pose and motion of every body at 200 Hz."""
        return self._take(self._source.bodies)

    @cached_property
    def contacts(self) -> arrays.Contacts:
        """Contacts of every roller at 200 Hz."""
        return replace(self._take(self._source.contacts), bearing=self.bearing)

    @cached_property
    def bearing(self) -> RollerBearing | None:
        """Bearing of the scene; ``None`` where no scene is known, or its text is of another program."""
        if self.description is not None and self.description.bearing is not None:
            return self.description.bearing
        if not self.scene_text:
            return None
        from beardyn_core.config.nouns import bearing_from_mapping
        from beardyn_core.config.yaml_text import read_mapping

        try:
            keys = read_mapping(self.scene_text, self.label).get("bearing")
            return bearing_from_mapping(keys, self.label) if isinstance(keys, dict) else None
        except InputError:
            return None

    @cached_property
    def load(self) -> arrays.Load:
        """Load on the journal and shaft speed that went into the run."""
        return self._take(self._source.load)

    @cached_property
    def temperature(self) -> arrays.Signal:
        """Temperature of each part every 0.2 s, values [sample, part], [K]; empty without the effect."""
        return self._take(self._source.temperature)

    @cached_property
    def diagnostics(self) -> arrays.Diagnostics:
        """Stamp [ns] and statuses of the twin every 0.2 s."""
        return self._take(self._source.diagnostics)

    @cached_property
    def results(self) -> arrays.Diagnostics:
        """Stamp [ns] and statuses of the monitor that ran next to the twin."""
        return self._take(self._source.results)

    @cached_property
    def plot_values(self) -> dict[str, arrays.Signal]:
        """Numbers that monitor and follower published for plots, by name, values [result, value low high]."""
        return self._take(self._source.plot_values)

    @cached_property
    def followed(self) -> arrays.Told:
        """Results of a follower: ``steps[]`` of `beardyn follow --json`."""
        return self._take(self._source.followed)

    @cached_property
    def residuals(self) -> arrays.Told:
        """Third octaves that a follower measured and those of its twin, each with its ``time_s``."""
        return self._take(self._source.residuals)

    @cached_property
    def source_time(self) -> tuple[tuple[int, int], ...]:
        """Stamps, and simulated time at each, where stamps are those of the load's source, both [ns]."""
        return self._take(self._source.source_time)

    @cached_property
    def truth(self) -> Mapping[str, Any]:
        """Facts of the run that no train could measure: faults and excitation, with labels of load and speed.

        Empty when a file has none. The keys are explained in docs/python.md.
        """
        if self.description is None:
            return {}
        truth, load = json.loads(json.dumps(dict(self.description.truth))), self.load
        with arrays.decoding_checked(self.label):
            return {**truth, **load_labels(load.time_ns, load.wrench, load.shaft_speed, truth)}

    def _take(self, part: Callable[[], Part]) -> Part:
        """Decode an array; a damaged file raises `InputError`."""
        with arrays.decoding_checked(self.label):
            return part()

    @property
    def labels(self) -> dict[str, Any]:
        """Numbers and names of `truth` without nesting, as a row of a table, for machine learning."""
        return flat_labels(self.truth)

    @cached_property
    def summary(self) -> RunSummary:
        """Means over the last whole cage revolutions, losses, rating life: what ``beardyn simulate`` prints.

        Of a run that was not simulated here it is made from the arrays: torque and cage speed are then
        those at 200 Hz, and the wall time comes from the diagnostics.

        Raises
        ------
        InputError
            The recording does not name its scene.
        """
        from beardyn_core.record.run_summary import summary_of

        return summary_of(self) if self._summary is None else self._summary()

    @cached_property
    def duration(self) -> float:
        """Simulated time from the first block to the last, [s]."""
        return self._take(self._source.duration)

    def described(self) -> RunDescription:
        """Give the description.

        Raises
        ------
        InputError
            The file has none, as one that was measured.
        """
        if self.measured:
            raise InputError(
                f"{self.label}: was measured, so there is no bearing in it to draw or to sum up; report, "
                "monitor and export read it"
            )
        if self.description is None:
            raise InputError(
                f"{self.label}: the recording does not name its bearing (no run.json and no topic "
                "truth); record the topic truth too"
            )
        return self.description

    @property
    def label(self) -> str:
        """Name for messages: the path, or that the run is in memory."""
        return "run in memory" if self.path is None else str(self.path)

    def monitor_inputs(self, sensor: str = "") -> Iterator[MonitorInput]:
        """Give the signals that a monitor may read, in parts in the order of time, as in a live run.

        Parameters
        ----------
        sensor : str
            Accelerometer to take; by default the first.

        Raises
        ------
        InputError
            There is none of that name.
        """
        if sensor and sensor not in self.sensors:
            raise InputError(f"{self.label}: has no sensor {sensor!r}; it has {', '.join(self.sensors)}")
        vibration = self.sensors[sensor] if sensor else self.vibration
        shaft, load, temperature = self.shaft, self.load, self.temperature
        received = measured_axes(vibration.values)
        box = temperature.components.index("axlebox") if len(temperature) else 0
        used = [0, 0, 0]
        for begin in range(0, len(vibration), MONITOR_PART):
            part = slice(begin, begin + MONITOR_PART)
            last = vibration.time_ns[part][-1]
            until = [
                int(np.searchsorted(each.time_ns, last, side="right")) for each in (shaft, load, temperature)
            ]
            turned, carried, warmed = (slice(*pair) for pair in zip(used, until, strict=True))
            used = until
            yield MonitorInput(
                vibration.time_ns[part], received[part],
                shaft.time_ns[turned], shaft.angle[turned],
                load.time_ns[carried], load.wrench[carried, 2],
                temperature.time_ns[warmed], temperature.values[warmed, box] if len(temperature) else _NONE,
            )  # fmt: skip

    def __repr__(self) -> str:
        """Describe scene, length and end of the run in two lines."""
        what = "blocks without a description" if self.path is None else "a recording without truth"
        if self.measured:
            what = f"measured files: {', '.join(each['name'] for each in self.measured.get('files', ()))}"
        elif self.description is not None:
            truth = self.truth
            what = (
                f"{truth.get('scene')}: bearing {truth.get('bearing')}, tier {truth.get('tier')}, "
                f"condition {truth.get('condition')}"
            )
        ending = self.status or self.problem or "how it ended is not known"
        sensors = ", ".join(f"{name} {signal.rate / 1e3:g} kHz" for name, signal in self.sensors.items())
        return f"Run of {what}\n  {self.duration:.2f} s, sensors: {sensors or 'none'}; {ending}"

    def to_xarray(self) -> Any:
        """Give all signals as an ``xarray.Dataset``: see `record.tables.to_xarray`."""
        from beardyn_core.record.tables import to_xarray

        return to_xarray(self)

    def to_pandas(self, signal: str = "vibration") -> Any:
        """Give one signal as a ``pandas.DataFrame``, a row a sample: see `record.tables.to_pandas`."""
        from beardyn_core.record.tables import to_pandas

        return to_pandas(self, signal)

    def to_parquet(self, path: Path | str, signals: Iterable[str] = (), force: bool = False) -> list[Path]:
        """Write signals to Parquet: see `record.exporting.export`, whose arguments these are."""
        return self._export(path, "parquet", signals, force)

    def to_csv(self, path: Path | str, signals: Iterable[str] = (), force: bool = False) -> list[Path]:
        """Write signals to CSV: see `record.exporting.export`, whose arguments these are."""
        return self._export(path, "csv", signals, force)

    def to_npz(self, path: Path | str, signals: Iterable[str] = (), force: bool = False) -> list[Path]:
        """Write signals to a NumPy archive: see `record.exporting.export`, whose arguments these are."""
        return self._export(path, "npz", signals, force)

    def to_hdf5(self, path: Path | str, signals: Iterable[str] = (), force: bool = False) -> list[Path]:
        """Write signals to HDF5: see `record.exporting.export`, whose arguments these are."""
        return self._export(path, "h5", signals, force)

    def to_wav(self, path: Path | str, signals: Iterable[str] = (), force: bool = False) -> list[Path]:
        """Write vibration to WAV: see `record.exporting.export`, whose arguments these are."""
        return self._export(path, "wav", signals, force)

    def _export(self, path: Path | str, kind: str, signals: Iterable[str], force: bool) -> list[Path]:
        from beardyn_core.record.exporting import export

        return export(self, path, kind=kind, signals=signals, force=force)
