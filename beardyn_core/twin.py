"""The twin: a scene that advances block by block; the same object on the desk and in the ROS node."""

from __future__ import annotations

import logging
import time
from copy import deepcopy
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.jit import LANE_WIDTH, when_compiling
from beardyn_core.base.versions import versions
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.physics.bodies.arrangement import BOTH_ROWS, Arrangement
from beardyn_core.physics.bodies.layout import SIGNAL_CHANNELS, SIGNAL_FORCE
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.bodies.rates import BLOCK_NS
from beardyn_core.physics.bodies.step_stages import stage_cycles
from beardyn_core.physics.cage.watch import CageWatch
from beardyn_core.physics.defect import grow
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.modal_body import body_of
from beardyn_core.physics.slow_thermal import (
    Warmth,
    advance_temperatures,
    blocks_between,
    cold_start,
    scene_at,
)
from beardyn_core.physics.statics.initial_equilibrium import rest_under, weight_on_cone
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.start import at_rest, initial_state
from beardyn_core.physics.tiers.state import Output, State, work_space
from beardyn_core.physics.tiers.status import Status, assess, describe, is_fatal, status_of_cages
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.rail.events import events_of
from beardyn_core.rail.load_buffer import LoadBuffer
from beardyn_core.scene.defect import truth_of
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import SNAPSHOT_RATES, Scene, snapshots_do_not_fit
from beardyn_core.scene.tier import TIERS as TIER_NOUNS
from beardyn_core.sensors.block import Block, EnergyAudit, body_names
from beardyn_core.sensors.channels import TRENDS_PER_BLOCK, Observer
from beardyn_core.sensors.labels import scene_labels
from beardyn_core.sensors.missing_rollers import absence_of
from beardyn_core.sensors.stage_clock import LOAD, OBSERVE, REST, StageClock

STAGES_SHARED_EVERY = 10  # blocks: how the step shares its time out changes slowly, and counting costs

COMPILING = "compiling the kernels of this set of effects: about a minute, kept for later"

log = logging.getLogger("beardyn")


@dataclass(frozen=True)
class Snapshot:
    """Everything the rest of a run depends on: what it is frozen in and goes on from."""

    index: int  # of the next block
    state: State
    parameters: Parameters
    load: LoadBuffer
    observer: Any  # a copy, with the states of all filters
    first_audit: Float | None  # [ENERGY_TERMS], energies at the start of the run [J]
    warmth: Warmth | None = None
    cages: CageWatch | None = None


class Twin:
    """A scene that advances in blocks of 20 ms.

    Attributes
    ----------
    load : LoadBuffer
        What has arrived and not been used, with the count of refused pieces.
    stages : StageClock
        Where the wall time of the blocks went.
    block_ns : int
        Simulated time of a block, [ns].
    """

    rows = BOTH_ROWS
    block_ns = BLOCK_NS

    def __init__(self, scene: Scene) -> None:
        if scene.axleboxes is not None:
            raise InputError(
                f"scene {scene.name}: has axleboxes, {2 * scene.axleboxes.axles} of them, and a twin is one: "
                "beardyn simulate runs them all; leave axleboxes out here"
            )
        if apart := snapshots_do_not_fit(scene.snapshot_rate, scene.numerics.steps_per_sample):
            raise InputError(f"scene {scene.name}: {apart}")
        self.scene = scene
        self._instants = TRENDS_PER_BLOCK * round(scene.snapshot_rate / SNAPSHOT_RATES[0])  # of a block
        self.load = LoadBuffer()
        self._arrangement = Arrangement(
            scene.bearing.roller_count, LANE_WIDTH, scene.rows, scene.missing_places
        )
        self._absence = absence_of(self._arrangement)
        self._lanes = Lanes(LANE_WIDTH)
        self._tier = TIERS[scene.tier]
        self._parameters = build_parameters(scene, self._arrangement, np.zeros(6))
        self._kernel_parameters = self._tier.parameters(scene, self._parameters)
        self._structure = body_of(scene)
        self._work = work_space(self._arrangement, self._parameters.effects.structure)
        self._steps = round(BLOCK_NS * 1e-9 / self._parameters.step)
        self._audit = np.zeros(ENERGY_TERMS)
        self._first_audit: Float | None = None
        self._state: State | None = None
        self._observer: Observer | None = None
        self._index = 0
        self.stages = StageClock()
        self._stage_cycles = stage_cycles(None)
        self._warmth = cold_start(scene) if scene.effects.thermal is not None else None
        self._cages = CageWatch.of(scene)
        self._channels = SIGNAL_CHANNELS + self._seat_channels
        self._signals = np.zeros((self.blocks_at_once * self._steps, self._channels))
        self._audited = scene.effects.audit is not None and "audit" not in scene.missing_effects

    @property
    def roller_count(self) -> int:
        """Rollers of each row."""
        return self.scene.bearing.roller_count

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names of the bodies in the order of `Block.body_pose`."""
        return body_names(self.roller_count)

    @property
    def step_signals(self) -> Float:
        """Every step of the last block, shape [step, channel]; the next block overwrites it."""
        return self._signals

    @property
    def next_end_ns(self) -> int:
        """Simulated time at the end of the next block, [ns]."""
        return (self._index + 1) * BLOCK_NS

    def warm(self) -> float:
        """Compile the kernels of this scene's effects, or load them from the cache.

        Returns
        -------
        float
            Wall time it took, [s].
        """
        began = time.perf_counter()
        with when_compiling(lambda: log.info(COMPILING)) as compiled:
            self._rehearse()
        took = time.perf_counter() - began
        if compiled:
            log.info("kernels ready after %.1f s", took)
        return took

    def _rehearse(self) -> None:
        """Compute a block at rest and discard it, so that all its kernels are compiled."""
        modes = 0 if self._structure is None else len(self._structure.rate)
        static = at_rest(self.scene.rows, self.roller_count, modes)
        state = initial_state(self.scene.bearing, self._arrangement, self._parameters, static, 1.0, 0.4)
        steps = self._steps
        buffer = LoadBuffer()
        buffer.append(LoadHistory(np.array([0, BLOCK_NS]), np.zeros((2, 6)), np.zeros(2), np.zeros((2, 3))))
        loads = buffer.at_steps(0, BLOCK_NS, steps)
        rollers, bodies = self._run(
            state, loads[: self._instants + 1].copy(), self._signals[: self._instants].copy(), 1
        )
        self._assess(state, steps)
        signals = np.zeros((steps, self._channels))
        observer = Observer(self.scene, self._arrangement, self._parameters, signals[0])
        observer.first_instant(*self._complete(state.rollers, state.bodies), loads[0, :6])
        block = observer.observe(0, signals, loads, rollers, bodies, 0, None, 0.0, None)
        _ = block.body_pose, block.body_twist, block.contacts  # worked out at the first look

    def _assess(self, state: State, steps: int) -> Status:
        """Judge the status after some steps."""
        effects = self._parameters.effects
        return assess(state, steps, self.scene.bearing.large_end_radius, effects.rib, effects.flanges)

    def start(self, load: LoadHistory) -> None:
        """Solve the static equilibrium under the first sample and begin at t = 0.

        Parameters
        ----------
        load : LoadHistory
            Its first sample stands at simulated time 0 or before it.

        Raises
        ------
        ValidityError
            The load cannot be used, or there is no equilibrium under it.
        """
        if not self.load.append(load):
            raise ValidityError(self.load.reason)
        scene = self.scene
        first = self._loads(0, BLOCK_NS, 1)[0]
        static, springs, on_cone = rest_under(
            scene,
            self._structure,
            first[:6],
            float(first[6]),
            laminae=scene.numerics.laminae,
            coupling=scene.effects.lamina_coupling,
        )
        self._parameters = build_parameters(scene, self._arrangement, springs, on_cone)
        self._kernel_parameters = self._tier.parameters(scene, self._parameters)
        self._state = self._tier.start(scene, self._arrangement, self._kernel_parameters, static, first)
        rest = np.zeros(self._channels)
        rest[SIGNAL_FORCE : SIGNAL_FORCE + 3] = first[:3]
        rest[SIGNAL_FORCE + 1] -= scene.mounting.axial_prop_stiffness * static.displacement[1]
        rest[SIGNAL_FORCE + 2] -= weight_on_cone(scene)
        self._observer = Observer(scene, self._arrangement, self._parameters, rest)
        self._observer.first_instant(*self._complete(self._state.rollers, self._state.bodies), first[:6])

    def feed(self, load: LoadHistory) -> bool:
        """Append load samples; False when they were refused (`load.reason` gives the reason)."""
        return self.load.append(load)

    @property
    def blocks_at_once(self) -> int:
        """Largest number of blocks in the next `advance`: several where only the kernel acts in between."""
        if any(isinstance(defect, Patch) and defect.growth is not None for defect in self.scene.defects):
            return 1
        allowed, thermal = TIER_NOUNS[self.scene.tier].blocks_at_once, self.scene.effects.thermal
        if thermal is None:
            return allowed
        between = blocks_between(thermal)
        return min(allowed, between - self._index % between)

    def covered(self) -> bool:
        """Tell whether the samples that the load of the next block depends on have arrived."""
        return self.load.covers(self.next_end_ns)

    @property
    def wanted_ns(self) -> int:
        """Time up to which the next block wants load samples, [ns]: beyond its end, see `LoadHistory`."""
        return self.load.wanted_ns(self.next_end_ns)

    def end_load(self) -> None:
        """Take note that no more load will come: the last samples are used as they are."""
        self.load.ended = True

    def advance(self, blocks: int = 1) -> Block:
        """Advance by a block.

        Parameters
        ----------
        blocks : int, optional
            Blocks of 20 ms in one, up to `blocks_at_once`: the same bits as one after the other, in less
            time.

        Raises
        ------
        ValidityError
            The model left its range of validity; the block is in the error's ``block``.
        """
        if not 1 <= blocks <= self.blocks_at_once:
            raise ValueError(f"blocks is {blocks}; allowed is 1 to {self.blocks_at_once} for this scene")
        if self._state is None or self._observer is None:
            raise ValidityError("the twin has not been started: it needs its first load")
        self.stages.begin()
        signals = self._signals[: blocks * self._steps]
        loads = self._loads(self._index * BLOCK_NS, (self._index + blocks) * BLOCK_NS, self._steps, blocks)
        self.stages.lap(LOAD)
        began = time.perf_counter()
        grow(self._parameters.effects.faults, self.scene, self._index * BLOCK_NS * 1e-9)
        rollers, bodies = self._run(self._state, loads, signals, blocks)
        wall = time.perf_counter() - began
        if self._index % STAGES_SHARED_EVERY < blocks:
            self._stage_cycles = stage_cycles(self._parameters.effects.timers)
        self.stages.lap_kernel(self._stage_cycles)
        status = self._assess(self._state, len(signals))
        if self._cages is not None:
            seconds = blocks * BLOCK_NS * 1e-9
            self._cages = self._cages.after(self.scene.bearing, bodies, float(loads[:, 6].mean()), seconds)
            status |= status_of_cages(self._cages)
        audit = self._energy_audit()
        temperature = self._warm_up(loads, blocks)
        block = self._observer.observe(
            self._index, signals, loads, rollers, bodies, int(status), audit, wall, temperature
        )
        self.stages.lap(OBSERVE)
        self._index += blocks
        self.stages.lap(REST)
        if is_fatal(status):
            moment = f"at {block.end_ns * 1e-9:.2f} s of simulated time"
            raise ValidityError(f"the run ended {moment}: {describe(status)}", block)
        return block

    def _loads(self, start_ns: int, end_ns: int, steps: int, blocks: int = 1) -> Float:
        """Interpolate the load at step ends about the bearing centre, shape [steps * blocks + 1, 10]."""
        loads = self.load.at_steps(start_ns, end_ns, steps, blocks)
        loads[:, :6] = self.scene.mounting.about_bearing_centre(loads[:, :6])
        return loads

    @property
    def _seat_channels(self) -> int:
        """Signals of every step for what the modes of the box give the sensors."""
        structure = self._parameters.effects.structure
        absent = structure is None or "structure" in self.scene.missing_effects
        return 0 if structure is None or absent else len(structure.seats) - 6

    def _run(self, state: State, loads: Float, signals: Float, blocks: int) -> tuple[Any, Float]:
        tier = self._tier
        kept = tier.trend_shape(state.rollers.shape, self._kernel_parameters)
        rollers = np.empty((blocks * self._instants, *kept))
        bodies = np.empty((blocks * self._instants, *state.bodies.shape))
        output = Output(signals, rollers, bodies, self._audit)
        tier.advance(self._lanes, state, self._work, loads, output, self._kernel_parameters)
        return self._complete(tier.shown(self._lanes, rollers, self._kernel_parameters), bodies)

    def _complete(self, rollers: Any, bodies: Float) -> tuple[Any, Float]:
        """Fill in the states of missing rollers for the observer."""
        if self._absence is None:
            return rollers, bodies
        whole = rollers if isinstance(rollers, np.ndarray) else rollers.whole()
        return self._absence.complete_rows(whole, bodies)

    def _warm_up(self, loads: Float, blocks: int) -> Float | None:
        """Compute the temperatures after blocks, [K], and update what depends on them in the kernels."""
        scene, state, before = self.scene, self._state, self._warmth
        thermal = scene.effects.thermal
        if before is None or thermal is None:
            return None
        assert state is not None
        between = blocks_between(thermal)
        if (self._index + blocks) % between:
            return before.temperature
        speed = float(loads[-1, 6])
        after = advance_temperatures(scene, thermal, before, state.energy, speed, between * BLOCK_NS * 1e-9)
        if (after.film_temperature, after.play) != (before.film_temperature, before.play):
            old = self._parameters
            new = build_parameters(scene_at(scene, after), self._arrangement, old.mounting.preload)
            self._parameters = new._replace(rollers=old.rollers, mounting=old.mounting)
            self._kernel_parameters = self._tier.parameters(scene_at(scene, after), self._parameters)
        self._warmth = after
        return after.temperature

    def _energy_audit(self) -> EnergyAudit | None:
        """Make the energy balance from the start of the run to the start of the block just computed."""
        if not self._audited:
            return None
        if self._first_audit is None:
            self._first_audit = self._audit.copy()
        return EnergyAudit.of(self._audit - self._first_audit)

    def truth(self) -> dict[str, Any]:
        """Write the facts of the run that no train could measure: scene, faults, labels, versions."""
        scene = self.scene
        return {
            "scene": scene.name,
            "purpose": scene.purpose,
            "bearing": scene.bearing.name,
            "tier": scene.tier,
            "effects": [name for name in scene.effect_names if name not in scene.missing_effects],
            "not_in_this_tier": {
                "effects": list(scene.missing_effects),
                "channels": list(TIER_NOUNS[scene.tier].absent),
            },
            "rows": scene.rows,
            "faults": [truth_of(defect, self._index * BLOCK_NS * 1e-9) for defect in scene.faults],
            "waviness": [asdict(wave) for wave in scene.waviness],
            "scatter": scene.scattered.truth(scene.bearing) if scene.scattered else None,
            "excitation": events_of(scene),
            "fault_frequencies_per_rev": fault_frequencies(scene.bearing).by_name,
            **scene_labels(scene),
            "laminae": scene.numerics.laminae,
            "step_s": self._parameters.step,
            "seed": scene.seed,
            "chosen": list(scene.chosen),
            "versions": versions(),
        }

    def snapshot(self) -> Snapshot:
        """Copy everything that the rest of the run depends on; `restore` continues bit-identically."""
        if self._state is None or self._observer is None:
            raise ValidityError("the twin has not been started: there is nothing to keep")
        return Snapshot(
            self._index,
            self._state.copy(),
            self._parameters,
            self.load.copy(),
            deepcopy(self._observer),
            deepcopy(self._first_audit),
            self._warmth,
            self._cages,
        )

    def restore(self, snapshot: Snapshot) -> None:
        """Go back to a snapshot of a twin of the same scene."""
        self._index = snapshot.index
        self._state = snapshot.state.copy()
        self._parameters = snapshot.parameters
        self._warmth, self._cages = snapshot.warmth, snapshot.cages
        scene = self.scene if self._warmth is None else scene_at(self.scene, self._warmth)
        self._kernel_parameters = self._tier.parameters(scene, self._parameters)
        self.load = snapshot.load.copy()
        self._first_audit = deepcopy(snapshot.first_audit)
        self._observer = deepcopy(snapshot.observer)
