"""Description of a run in its recording: scene, truth, bodies and the shape of the bearing."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, is_dataclass
from math import atan, pi, sin, tan
from types import UnionType
from typing import TYPE_CHECKING, Any, Union, get_args, get_origin, get_type_hints
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import read_object
from beardyn_core.bearing.cylindrical import RIBS
from beardyn_core.bearing.kinematics import frequencies
from beardyn_core.scene.defect import Defect, MissingRoller, defect_from
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.sensor import RATES
from beardyn_core.sensors.labels import load_labels

if TYPE_CHECKING:
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.scene.scene import Scene

DESCRIPTION_KEY = "description"
MOST_ROLLERS, MOST_BODIES, MOST_SENSORS = 200, 1000, 64
LARGEST_SIZE, LARGEST_NUMBER = 10.0, 1e12  # [m]; of any number
_SENSOR = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,79}").fullmatch


@dataclass(frozen=True)
class BearingShape:
    """Dimensions that drawing and signal analysis need, stored with every run, [m], [rad]."""

    name: str
    roller_count: A[int, "per row"]
    pitch_diameter: A[float, "through the roller centres"]
    roller_diameter: A[float, "mean"]
    roller_length: A[float, "whole length of a roller"]
    contact_angle: A[float, "angle of the roller axis against the bearing axis"]
    row_spacing: A[float, "between the roller centres of the rows"]
    bore: float
    outer_diameter: float
    width: float
    rib_contact_height: A[float, "of the rib contact above the cone raceway"]
    # of cylindrical bearings; recordings of earlier versions have them not
    cup_ribs: A[str, "sides on which the outer ring of a row has a rib: none, inner, outer, both"] = "none"
    cone_ribs: A[str, "the same of the inner ring"] = "outer"
    cup_rib_height: A[float, "above the raceway"] = 0.0
    cone_rib_height: A[float, "above the raceway"] = 0.0
    roller_profile_radius: A[float, "of the profile of a barrel; 0 where rollers are straight"] = 0.0

    @classmethod
    def of(cls, bearing: RollerBearing) -> BearingShape:
        """Take the shape of a bearing."""
        return cls(
            **{
                member.name: getattr(bearing, member.name)
                for member in fields(cls)
                if hasattr(bearing, member.name)
            }
        )

    @property
    def is_cylindrical(self) -> bool:
        """Whether the rollers are cylinders: their axes are parallel to that of the bearing."""
        return self.contact_angle == 0.0

    @property
    def is_spherical(self) -> bool:
        """Whether the rollers are barrels, whose outer ends lean towards the bearing axis."""
        return self.roller_profile_radius > 0.0

    @property
    def slant(self) -> float:
        """Angle of the roller axis to the bearing axis, positive where it opens outwards, [rad]."""
        return -self.contact_angle if self.is_spherical else self.contact_angle

    @property
    def apex_distance(self) -> float:
        """From the common apex of tapered rollers to the middle of one, along its axis, [m]."""
        return self.pitch_diameter / (2.0 * sin(self.contact_angle))

    @property
    def half_angle(self) -> float:
        """Half the cone angle of a roller, [rad]."""
        if self.is_spherical:
            return 0.0
        return atan(self.roller_diameter * sin(self.contact_angle) / self.pitch_diameter)

    @property
    def cup_angle(self) -> float:
        """Half the cone angle of the cup raceway, [rad]."""
        return self.contact_angle + self.half_angle

    @property
    def cone_angle(self) -> float:
        """Half the cone angle of the cone raceway, [rad]."""
        return self.contact_angle - self.half_angle

    @property
    def large_end_radius(self) -> float:
        """Radius of a roller at its large end, [m]."""
        return self.radius_at(self.roller_length / 2.0)

    @property
    def small_end_radius(self) -> float:
        """Radius of a roller at its small end, [m]."""
        return self.radius_at(-self.roller_length / 2.0)

    def radius_at(self, place: float) -> float:
        """Compute the radius of a roller at a place along its axis, from its middle to the large end, [m]."""
        drop = 0.5 * place**2 / self.roller_profile_radius if self.is_spherical else 0.0
        return 0.5 * self.roller_diameter + place * tan(self.half_angle) - drop

    @property
    def fault_frequencies(self) -> dict[str, float]:
        """FTF, BPFO, BPFI, BSF of one row per shaft revolution, cup at rest."""
        return frequencies(
            self.roller_count, self.pitch_diameter, self.roller_diameter, self.contact_angle
        ).by_name


@dataclass(frozen=True)
class RunDescription:
    """Description that a sink gets before the first block and stores, so that a file explains itself."""

    scene: A[str, "name of the scene"]
    scene_text: A[str, "resolved YAML of the scene"]
    shape: BearingShape
    body_names: A[tuple[str, ...], "order of the bodies in `Block.body_pose`"]
    sensor_names: A[tuple[str, ...], "order of the accelerometers in `Block.vibration`"]
    defects: tuple[Defect, ...]
    truth: A[Mapping[str, Any], "JSON-able, from ``Twin.truth``: faults, effects, versions, seed"]
    load: A[
        LoadHistory | None,
        "load on the journal when it is known in advance (desk run): written to the file as ``load/blocks``. "
        "A live graph records the topic instead",
    ] = None
    sensor_rates: A[tuple[float, ...], "of each of them, [Hz]"] = ()
    # of a run in memory; in a file it stands in `scene_text`
    bearing: RollerBearing | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if not self.sensor_rates:  # all at the usual one, as every recording before there was another
            object.__setattr__(self, "sensor_rates", (RATES[0],) * len(self.sensor_names))

    @classmethod
    def of(
        cls,
        scene: Scene,
        truth: Mapping[str, Any],
        body_names: Sequence[str],
        load: LoadHistory | None = None,
        text: str | None = None,
    ) -> RunDescription:
        """Describe a run of a scene; the truth gets labels of the load when the load is known.

        ``text`` is that of the scene, written when it is left out, which takes longer than a short run of a
        fast tier: empty where nobody reads it.
        """
        from beardyn_core.config.yaml_text import scene_text  # pydantic is not for readers of a recording

        if load is not None:
            truth = {**truth, **load_labels(load.time_ns, load.wrench, load.shaft_speed, truth)}
        return cls(
            scene=scene.name,
            scene_text=scene_text(scene) if text is None else text,
            shape=BearingShape.of(scene.bearing),
            body_names=tuple(body_names),
            sensor_names=tuple(sensor.name for sensor in scene.sensors),
            defects=scene.faults,
            truth=truth,
            load=load,
            sensor_rates=tuple(sensor.rate for sensor in scene.sensors),
            bearing=scene.bearing,
        )

    @property
    def roller_count(self) -> int:
        """Rollers per row."""
        return self.shape.roller_count

    @property
    def absent_bodies(self) -> frozenset[str]:
        """Names of missing bodies; the recording has a made-up motion in their place."""
        missing = [defect for defect in self.defects if isinstance(defect, MissingRoller)]
        absent = {f"roller_{each.row}_{each.roller}" for each in missing}
        if self.truth.get("rows", 2) == 1:
            absent |= {"cage_1", *(f"roller_1_{k}" for k in range(self.roller_count))}
        return frozenset(absent)

    def to_json(self) -> str:
        """Write the content of the ``truth`` topic: the truth, and the description under its own key."""
        description = {
            "scene": self.scene,
            "scene_text": self.scene_text,
            "shape": asdict(self.shape),
            "body_names": list(self.body_names),
            "sensor_names": list(self.sensor_names),
            "sensor_rates_Hz": list(self.sensor_rates),
            "defects": [asdict(defect) for defect in self.defects],
        }
        return json.dumps({**self.truth, DESCRIPTION_KEY: description})

    @classmethod
    def from_json(cls, text: str) -> RunDescription:
        """Read the description from the content of the ``truth`` topic.

        Raises
        ------
        InputError
            The text is not a description written by `to_json`.
        """
        try:
            truth = read_object(text, {DESCRIPTION_KEY: dict})
            stored = truth.pop(DESCRIPTION_KEY)
            found = cls(
                scene=stored["scene"],
                scene_text=stored["scene_text"],
                shape=BearingShape(**stored["shape"]),
                body_names=tuple(stored["body_names"]),
                sensor_names=tuple(stored["sensor_names"]),
                defects=tuple(defect_from(defect) for defect in stored["defects"]),
                truth=truth,
                sensor_rates=tuple(stored.get("sensor_rates_Hz", ())),
            )
            _check(found)
            return found
        except (InputError, ValueError, KeyError, TypeError, AttributeError, ArithmeticError) as error:
            raise InputError(
                f"the truth of the recording does not describe a beardyn run ({error!r}); "
                "it was written by another program or another version"
            ) from error


def _check(run: RunDescription) -> None:
    """Check a description that anybody may have written, so that nobody computes or draws with nonsense.

    Raises
    ------
    ValueError
        A value is of another kind than its field, or no bearing has it.
    """
    parts = [run.shape, *run.defects, *(part for each in run.defects for part in _dataclasses_in(each))]
    for part in parts:
        for name, hint in get_type_hints(type(part)).items():
            if not _fits(getattr(part, name), hint):
                raise ValueError(f"{name} of {type(part).__name__} is {getattr(part, name)!r:.60}")
    shape = run.shape
    if not 1 <= shape.roller_count <= MOST_ROLLERS:
        raise ValueError(f"roller_count is {shape.roller_count}; allowed is 1 to {MOST_ROLLERS}")
    sizes = (shape.pitch_diameter, shape.roller_diameter, shape.roller_length, shape.outer_diameter)
    if not (all(0.0 < size < LARGEST_SIZE for size in sizes) and 0.0 <= shape.contact_angle < pi / 2.0):
        raise ValueError("a dimension of the bearing is none")
    heights = (shape.cup_rib_height, shape.cone_rib_height)
    if not (
        all(0.0 <= height < shape.roller_diameter for height in heights)
        and {shape.cup_ribs, shape.cone_ribs} <= set(RIBS)
    ):
        raise ValueError("a rib of the bearing is none")
    texts = (run.scene, run.scene_text, *run.body_names)
    if not all(isinstance(text, str) for text in texts) or len(run.body_names) > MOST_BODIES:
        raise ValueError("the scene or the names of the bodies are no texts")
    names = run.sensor_names
    if len(names) > MOST_SENSORS or not all(isinstance(name, str) and _SENSOR(name) for name in names):
        raise ValueError("a sensor has a name that no topic can have")
    if len(set(names)) < len(names) or len(run.sensor_rates) != len(names):
        raise ValueError("the names and rates of the sensors contradict each other")
    if not all(_fits(rate, float) and rate > 0.0 for rate in run.sensor_rates):
        raise ValueError("a sensor has a rate that is none")


def _dataclasses_in(part: object) -> list[Any]:
    return [value for value in vars(part).values() if is_dataclass(value)]


def _fits(value: object, hint: Any) -> bool:
    """Check whether a value is of the type of its field; what is no plain type is left to its class."""
    if get_origin(hint) in (Union, UnionType):
        return any(_fits(value, each) for each in get_args(hint))
    if hint is float:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < LARGEST_NUMBER
    if hint is int:
        return isinstance(value, int) and not isinstance(value, bool) and abs(value) < LARGEST_NUMBER
    return isinstance(value, hint) if hint in (str, bool, type(None)) else True
