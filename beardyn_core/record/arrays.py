"""The arrays of a run: signals over time, angles, bodies, contacts, load."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.sensors.block import CONTACT_KINDS, LARGEST, WATCHED

if TYPE_CHECKING:
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.record.messages import Diagnostic

Diagnostics = tuple[tuple[int, "tuple[Diagnostic, ...]"], ...]
Told = tuple[Mapping[str, Any], ...]  # JSON objects, in the order of time


@contextmanager
def decoding_checked(path: Path | str) -> Iterator[None]:
    """Turn any failure of decoding into an `InputError` about the file.

    Chunks with checksums do not come this far when they are damaged; messages without, or of somebody
    else's making, may hold anything.
    """
    try:
        yield
    except (InputError, OSError):
        raise
    except Exception as error:
        raise InputError(
            f"{path}: what is in it cannot be used ({type(error).__name__}: {error}); it is damaged, or "
            "not a recording of an axlebox"
        ) from error


@dataclass(frozen=True, eq=False)
class Timed:
    """Base of all signals: the time of each sample."""

    time_ns: A[Int, "shape [sample], simulated time, the delay of filters compensated, [ns]"]

    def __len__(self) -> int:
        return len(self.time_ns)

    @property
    def time(self) -> Float:
        """Simulated time of each sample, shape [sample], [s]."""
        return np.asarray(self.time_ns * 1e-9, np.float64)

    @property
    def rate(self) -> float:
        """Samples a second, gaps left out, to six digits; NaN for fewer than two samples, [Hz]."""
        if len(self) < 2:
            return float("nan")
        steps = np.diff(self.time_ns)
        usual = np.median(steps)  # a whole number of nanoseconds, which the mean is not
        steps = steps[(steps > usual / 1.5) & (steps < usual * 1.5)]
        return float(f"{1e9 / steps.mean():.6g}") if len(steps) else float("nan")


@dataclass(frozen=True, eq=False)
class Signal(Timed):
    """One quantity over time."""

    values: A[Float, "shape [sample] or [sample, component]"]
    components: A[tuple[str, ...], "names along the last axis of `values`; empty for a scalar"]
    unit: str
    sample: A[Int, "shape [sample], running index that shows losses; empty where none is kept"]

    def __repr__(self) -> str:
        """Give shape, rate and unit."""
        names = f" ({', '.join(self.components)})" if self.components else ""
        return f"Signal{list(self.values.shape)}{names} at {self.rate:g} Hz, [{self.unit}]"


@dataclass(frozen=True, eq=False)
class Turning(Timed):
    """Angle and speed of things that turn about the bearing axis."""

    angle: A[Float, "shape [sample], [sample, row] or [sample, row, roller], from +z towards +x, [rad]"]
    speed: A[Float, "of the same shape, [rad/s]"]

    def __repr__(self) -> str:
        """Give shape and rate."""
        return f"Turning{list(self.angle.shape)}: angle [rad], speed [rad/s] at {self.rate:g} Hz"


@dataclass(frozen=True, eq=False)
class Bodies(Timed):
    """Pose and motion of all bodies."""

    names: A[tuple[str, ...], "``cup``, ``cone``, ``cage_0``, ``cage_1``, ``roller_<row>_<number>``"]
    pose: A[Float, "shape [snapshot, body, 7], x, y, z, qx, qy, qz, qw, [m, -]"]
    twist: A[Float, "shape [snapshot, body, 6], vx, vy, vz, wx, wy, wz, [m/s, rad/s]"]
    sample: A[Int, "shape [snapshot]"]

    def __repr__(self) -> str:
        """Give shape and rate."""
        return f"Bodies: {len(self.names)} bodies, {len(self)} snapshots at {self.rate:g} Hz"


@dataclass(frozen=True, eq=False)
class Contacts(Timed):
    """Contacts of every roller with cup, cone, rib and pocket."""

    point: A[Float, "shape [snapshot, row, roller, kind, 3], [m]; NaN without contact, as `slip` and `film`"]
    force: A[Float, "shape [snapshot, row, roller, kind, 3], of the partner on the roller, [N]; else zero"]
    slip: A[Float, "shape [snapshot, row, roller, kind], sliding speed, [m/s]"]
    film: A[Float, "shape [snapshot, row, roller, kind], film thickness, [m]"]
    # shape [snapshot, row, roller, kind], largest load in any step since the snapshot before, [N]; NaN of
    # pockets, whose loads are not watched, and in recordings of earlier versions
    largest: Float
    bearing: A[RollerBearing | None, "whose contacts they are; ``None`` where no scene names it"] = None
    kinds = CONTACT_KINDS

    @cached_property
    def load(self) -> Float:
        """Magnitude of the force, shape [snapshot, row, roller, kind], [N]."""
        return np.asarray(np.linalg.norm(self.force, axis=-1), np.float64)

    @cached_property
    def pressure(self) -> Float:
        """Largest Hertz pressure of each contact under `load`, shape [snapshot, row, roller, kind], [Pa].

        See `physics.hertz_pressure.pressure_law`: the load of a raceway is spread along the roller as its
        profile spreads it, which tilt and the edges of a spall exceed. NaN of pockets, and where no scene
        names the bearing.
        """
        return self._pressure_under(self.load)

    @cached_property
    def largest_pressure(self) -> Float:
        """`pressure` under the `largest` load in any step since the snapshot before, same shape, [Pa]."""
        return self._pressure_under(self.largest)

    def _pressure_under(self, load: Float) -> Float:
        from beardyn_core.physics.hertz_pressure import NO_PRESSURE, pressure_law

        bearing = self.bearing
        laws = [NO_PRESSURE if bearing is None else pressure_law(bearing, kind) for kind in self.kinds]
        return np.stack([law.of(load[..., k]) for k, law in enumerate(laws)], axis=-1)

    @property
    def touching(self) -> NDArray[np.bool_]:
        """Whether there is a contact, shape [snapshot, row, roller, kind]."""
        return np.asarray(np.isfinite(self.point[..., 0]))

    def of(self, kind: str) -> int:
        """Find the index of a kind of contact: ``cup``, ``cone``, ``rib`` or ``pocket``."""
        return self.kinds.index(kind)

    def __repr__(self) -> str:
        """Give shape and rate."""
        return (
            f"Contacts{list(self.slip.shape)} (kinds {', '.join(self.kinds)}) at {self.rate:g} Hz: "
            "force [N], pressure [Pa], slip [m/s], film [m]"
        )


def contacts_of(time_ns: Int, numbers: Float) -> Contacts:
    """Make contacts of `CONTACT_FIELDS`, shape [snapshot, row, roller, kind, field], which are changed."""
    gone = ~np.any(numbers[..., 3:6] != 0.0, axis=-1)
    numbers[gone, :3] = numbers[gone, 6:LARGEST] = np.nan
    numbers[:, :, :, WATCHED:, LARGEST] = np.nan
    return Contacts(
        time_ns, numbers[..., :3], numbers[..., 3:6], numbers[..., 6], numbers[..., 7], numbers[..., LARGEST]
    )


@dataclass(frozen=True, eq=False)
class Load(Timed):
    """Load on the journal and shaft speed, as they went into the run."""

    wrench: A[Float, "shape [sample, 6], fx, fy, fz, mx, my, mz, [N, N m]"]
    shaft_speed: A[Float, "shape [sample], [rad/s]"]
    bogie: A[Float, "shape [sample, 3], displacement of the bogie end of the suspension, [m]"]
    sample: A[Int, "shape [sample]"]
    components = WRENCH_AXES

    def __repr__(self) -> str:
        """Give the number of samples and the rate."""
        return f"Load: wrench [N, N m], shaft_speed [rad/s], {len(self)} samples at {self.rate:g} Hz"


def no_signal(components: tuple[str, ...], unit: str) -> Signal:
    """Give a signal without samples."""
    nothing = np.zeros(0, np.int64)
    shape = (0, len(components)) if components else (0,)
    return Signal(nothing, np.zeros(shape), components, unit, nothing)
