"""What is measured of a run, block by block."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import (
    ANGLE,
    AXIS,
    CAGE_BODY,
    CONE_BODY,
    LINEAR,
    MASK,
    PENETRATION,
    RATE,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    VELOCITY,
)
from beardyn_core.physics.tiers.state import State
from beardyn_core.physics.tiers.status import chatter_index
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Snapshot, Twin

Float = NDArray[np.float64]

# Loads below it are not looked at as a scale of force [N].
_SMALLEST_SCALE = 100.0
STATISTICS = ("force", "force_scatter", "torque", "cage_speed", "roller_load")
_CHANNELS = ("force_waveform", "acceleration", "shaft_torque", "cage_speed", "roller_speed", "body_pose",
             "body_twist", "contacts")  # fmt: skip


@dataclass(frozen=True)
class Measures:
    """What a run came to; ``None`` where the tier has no such thing.

    Parameters
    ----------
    simulated : float
        [s].
    status : int
        Every status bit that was set.
    finite : bool
        Every channel of every block.
    energy_residual : float or None
        Of the audit at the end, [-].
    numerical_share : float or None
        Dissipation of the time step over all dissipation, [-].
    stored : float or None
        Largest change of kinetic and elastic energy, [J].
    penetration : float or None
        Largest raceway approach, [m].
    chatter_index : float or None
        Largest over contacts and blocks, [-].
    axis_error, quaternion_error : float
        Largest deviation of a roller axis and of a body's quaternion from length 1, [-].
    momentum_residual : float or None
        Largest change of the momentum of journal, rollers and cages in a block that no force accounts
        for, over force times duration of the block, [-].
    mean_force, peak_force : float
        Of the rollers' force on the cup: size of its mean over the second half, largest size, [N]. Momentum
        balances the mean of each component. The mean of the size is more than that: under a load F_z by about
        the mean of F_x^2 / 2 F_z.
    mean_torque, torque_scatter : float
        On the shaft: mean, and standard deviation at every step in the second half, [N m].
    cage_speed_ratio : float
        Mean of both cages in the last quarter, nominal 1, NaN with the shaft at rest, [-].
    cage_speed : float
        The same as a speed, [rad/s].
    roller_load : float
        Largest force between roller and cup, [N].
    skew : float
        Largest angle of a roller about its radial line, [rad].
    tilt : float
        Largest tilt of the journal against the cup, [rad].
    differing : int
        Numbers that differ from a run that should be the same to the last bit.
    """

    simulated: float = 0.0
    status: int = 0
    finite: bool = True
    energy_residual: float | None = None
    numerical_share: float | None = None
    stored: float | None = None
    penetration: float | None = None
    chatter_index: float | None = None
    axis_error: float | None = None
    quaternion_error: float | None = None
    momentum_residual: float | None = None
    mean_force: float = math.nan
    peak_force: float = math.nan
    mean_torque: float = math.nan
    torque_scatter: float = math.nan
    cage_speed_ratio: float = math.nan
    cage_speed: float = math.nan
    roller_load: float = math.nan
    skew: float = math.nan
    tilt: float = math.nan
    differing: int = 0


@dataclass
class Watch:
    """Collects the measures of a run; can be pickled with a snapshot of the twin.

    Parameters
    ----------
    scene : Scene
    """

    scene: Scene
    rows: list[list[float]] = field(default_factory=list)
    end_ns: int = 0
    largest: dict[str, float] = field(default_factory=dict)
    status: int = 0
    finite: bool = True
    audit: tuple[float, float] | None = None  # residual, share of the numerical dissipation

    def see(self, twin: Twin, block: Block, before: Snapshot | None) -> None:
        """Take in a block and the state after it; that before it is asked for in tier `full` alone."""
        after = twin.snapshot()
        self.end_ns = block.end_ns
        scene = self.scene
        self.status |= block.status
        self.finite &= all(bool(np.isfinite(getattr(block, name)).all()) for name in _CHANNELS)
        size = np.linalg.norm(block.force_waveform[:, :3], axis=1)
        loads = np.linalg.norm(block.contacts[:, :, :, 0, 3:6], axis=-1).max(axis=(1, 2))
        steps = round((block.end_ns - block.start_ns) * 1e-9 / twin.truth()["step_s"])
        signals = twin.step_signals[:steps]
        torque, bodies = signals[:, SIGNAL_TORQUE], after.state.bodies
        self.rows.append(
            [size.mean(), size.var(), torque.mean(), bodies[CAGE_BODY:, RATE].mean(), loads.mean(),
             torque.mean(), torque.var(), bodies[CONE_BODY, RATE], *block.force_waveform[:, :3].mean(axis=0)]
        )  # fmt: skip
        self._most("peak_force", float(size.max()))
        self._most("roller_load", float(loads.max()))
        poses = block.body_pose
        self._most("quaternion_error", float(np.abs(np.linalg.norm(poses[..., 3:], axis=-1) - 1.0).max()))
        axes = after.state.rollers[:, AXIS : AXIS + 3]
        self._most("axis_error", float(np.abs(np.linalg.norm(axes, axis=1) - 1.0).max()))
        self._most("skew", float(np.arcsin(np.clip(np.abs(axes[:, 1]), 0.0, 1.0)).max()))
        self._most("tilt", _relative_tilt(poses))
        if scene.tier != "full":
            return
        assert before is not None
        self._most("penetration", float(after.state.rollers[:, PENETRATION].max()))
        self._most("chatter_index", float(chatter_index(after.state, len(signals)).max()))
        self._most("momentum_residual", _momentum_residual(scene, twin, before, after, signals))
        if block.audit is not None:
            audit = block.audit
            lost = audit.dissipated + abs(audit.numerical)
            self.audit = (audit.residual, abs(audit.numerical) / lost if lost > 0.0 else 0.0)
            self._most("stored", abs(audit.stored))

    def _most(self, name: str, value: float) -> None:
        # a NaN is the largest of all
        if not value <= self.largest.get(name, -math.inf):
            self.largest[name] = value

    def statistics(self) -> Float:
        """Return the `STATISTICS` of each block, shape [block, statistic]."""
        return np.array(self.rows)[:, : len(STATISTICS)]

    def measures(self) -> Measures:
        """Sum up the blocks so far."""
        if not self.rows:
            return Measures()
        rows = np.array(self.rows)
        late = rows[len(rows) // 2 :]
        last = rows[-max(1, len(rows) // 4) :]
        speed = float(last[:, 7].mean())
        nominal = fault_frequencies(self.scene.bearing).ftf * speed
        cage = float(last[:, 3].mean())
        known: dict[str, Any] = dict(self.largest)
        if self.audit is not None:
            known["energy_residual"], known["numerical_share"] = self.audit
        return Measures(
            simulated=self.end_ns * 1e-9,
            status=self.status,
            finite=self.finite,
            mean_force=float(np.linalg.norm(late[:, 8:11].mean(axis=0))),
            mean_torque=float(late[:, 5].mean()),
            torque_scatter=math.sqrt(float(late[:, 6].mean())),
            cage_speed_ratio=cage / nominal if abs(nominal) > 1e-3 else math.nan,
            cage_speed=cage,
            **known,
        )


def _relative_tilt(poses: Float) -> float:
    """Return the largest angle between the axes of cone and cup, shape [snapshot, body, 7]."""
    axes = []
    for body in (0, 1):
        x, y, z, w = np.moveaxis(poses[:, body, 3:], -1, 0)
        axes.append(np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], axis=-1))
    return float(np.linalg.norm(np.cross(axes[0], axes[1]), axis=-1).max())


def _momentum_residual(scene: Scene, twin: Twin, before: Snapshot, after: Snapshot, signals: Float) -> float:
    """Compare the momentum of journal, rollers and cages with load, weight and the cup's share, [-]."""
    steps, seconds = len(signals), Twin.block_ns * 1e-9
    start = before.index * Twin.block_ns
    loads = before.load.copy().at_steps(start, start + Twin.block_ns, steps)[1:, :3]
    on_cup = signals[:, SIGNAL_FORCE : SIGNAL_FORCE + 3]
    impulse = seconds * (loads.mean(axis=0) - on_cup.mean(axis=0))
    arrangement = Arrangement(scene.bearing.roller_count, LANE_WIDTH)
    real = arrangement.to_rollers(after.parameters.rollers[:, MASK])
    carried = _mass_of_rollers_and_cages(scene, real)
    fall = scene.effects.gravity.acceleration if scene.effects.gravity else 0.0
    impulse[2] -= fall * carried * seconds
    change = _momentum(scene, after.state, real) - _momentum(scene, before.state, real)
    scale = max(np.linalg.norm(loads, axis=1).max(), np.linalg.norm(on_cup, axis=1).max(), _SMALLEST_SCALE)
    return float(np.abs(change - impulse).max() / (scale * seconds))


def _mass_of_rollers_and_cages(scene: Scene, real: Float) -> float:
    cages = 2.0 * scene.bearing.cage.mass if scene.effects.cage else 0.0
    return float(real.sum()) * scene.bearing.roller_mass + cages


def _momentum(scene: Scene, state: State, real: Float) -> Float:
    """Return the momentum of journal, rollers and cages, world axes, [N s]."""
    arrangement = Arrangement(scene.bearing.roller_count, LANE_WIDTH)
    fields = arrangement.to_rollers(np.moveaxis(state.rollers, 1, 0))
    angle, (radial, around, axial) = fields[ANGLE], fields[VELOCITY : VELOCITY + 3]
    cosine, sine, mass = np.cos(angle), np.sin(angle), scene.bearing.roller_mass * real
    side = np.array([[-1.0], [1.0]])  # row 0 is the mirror image
    rollers = np.array(
        [
            (mass * (radial * sine + around * cosine)).sum(),
            (mass * side * axial).sum(),
            (mass * (radial * cosine - around * sine)).sum(),
        ]
    )
    journal = scene.mounting.journal_mass + scene.bearing.cone_mass
    cages = scene.bearing.cage.mass * state.bodies[CAGE_BODY:, LINEAR : LINEAR + 3].sum(axis=0)
    return np.asarray(rollers + journal * state.bodies[CONE_BODY, LINEAR : LINEAR + 3] + cages)
