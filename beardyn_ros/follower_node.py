"""Follow one bearing as a node: load, end play and spall from what a train has.

Inputs are ``vibration``, ``shaft`` and ``temperature`` of the axlebox; those of a real one are remapped:
``-r vibration:=measured/vibration``. It never reads ``truth``, ``contacts``, ``bodies`` or
``joint_states``, and loads only where the parameter ``load`` is ``topic``.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
from rclpy.node import Node

from beardyn_core.api.making import scene as make_scene
from beardyn_core.api.twin_residual import residual_beside
from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.config import load_plate
from beardyn_core.follow.conditioning import known_load_of
from beardyn_core.follow.descriptors import describe
from beardyn_core.follow.estimate_json import residual_object, step_object
from beardyn_core.follow.estimator import Estimates, Estimator
from beardyn_core.follow.follower_values import follower_values
from beardyn_core.follow.following import WAITING, Followed
from beardyn_core.follow.inference import doubt_of
from beardyn_core.follow.known_load import KnownLoad, combine_loads
from beardyn_core.follow.live_choice import LiveChoice
from beardyn_core.follow.load_checks import read_axle_loads
from beardyn_core.follow.mounting import Mounting
from beardyn_core.follow.mounting_search import search_mountings
from beardyn_core.follow.mounting_watch import MountingWatch
from beardyn_core.follow.residual import Residual
from beardyn_core.follow.run_stretches import follower_of
from beardyn_core.follow.service import Service
from beardyn_core.follow.windowing import StretchIntake
from beardyn_core.record.messages import (
    Diagnostic,
    encode_diagnostics,
    encode_told,
)
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.labels import HEALTHY
from beardyn_ros.diagnostics import FOLLOWER, OK, WARN, diagnostic_name
from beardyn_ros.frames import frame_of
from beardyn_ros.load_reception import LoadReception
from beardyn_ros.node_parameters import PARAMETERS
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.runtime import run_node, wall_timer
from beardyn_ros.train_signals import Hearer, TrainSignals
from beardyn_ros.typed_topics import TypedTopics
from beardyn_ros.value_topics import ValueTopics
from beardyn_ros.wire import TopicPublishers

TICK_S = 0.05
REPORT_PERIOD_S = 0.5
LAST_VALUES_S = 1.0
LAST_COMPARISON_S = 15.0  # longest wait at the end; the recorder waits 20 s for the last word
KEPT_ROWS = 4  # stretches that are compared with the parallel twin


class FollowerNode(Node):
    """Shows vibration and shaft to a `Follower` and publishes what it knows."""

    def __init__(self) -> None:
        super().__init__(FOLLOWER, namespace="axlebox")
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS["follower"])
        self._service = Service(1e3 * self._values.mileage, 1e-3 * self._values.wheel_diameter)
        self._worker = ThreadPoolExecutor(1)
        frame = frame_of(self.get_namespace())
        typed = TypedTopics.wanted(self, self._values.typed, frame)
        self._out = TopicPublishers(
            self, "follower/estimate", "follower/residual", "/diagnostics", typed=typed
        )
        self._numbers = ValueTopics(self._out, FOLLOWER, frame, self._values.values)
        self._load = self._make_load()
        self._begin()
        hearer = Hearer(self._begin, self._receive_vibration, self._receive_shaft, self._receive_temperature)
        further = {} if self._load_received is None else self._load_received.handlers
        self._signals = TrainSignals(self, hearer, further)
        self._reported_at = 0.0
        wall_timer(self, TICK_S, self._tick)

    def _make_load(self) -> KnownLoad | None:
        """Read the load that is known from the parameters, or prepare to receive it."""
        self._load_received: LoadReception | None = None
        problems, given = [], self._values.load.strip()
        try:
            if given.startswith("topic"):
                self._load_received = LoadReception(given)
        except InputError as error:
            problems += [f"node follower, parameter 'load' {each}" for each in error.problems]
        try:
            self._axle_loads = read_axle_loads(self._values.axle_load, "parameter 'axle_load'")
        except InputError as error:
            problems += [f"node follower, {each}" for each in error.problems]
        found = None
        try:
            found = known_load_of("" if given.startswith("topic") else given, [self._values.load_sensor])
        except InputError as error:
            options = {"--load-kn": "parameter 'load'", "--load-sensor": "parameter 'load_sensor'"}
            for each in error.problems:
                for option, name in options.items():
                    each = each.replace(option, name)
                problems.append(f"node follower, {each}")
        if problems:
            raise InputError(problems)
        return found

    def _load_of(self, end_ns: int) -> KnownLoad | None:
        """Give the load that is known in the stretch that ends then."""
        if self._load_received is None:
            return self._load
        begin_ns = end_ns - round(1e9 * self._follower.estimator.stretch)
        received = self._load_received.load_between(begin_ns, end_ns)
        return combine_loads([each for each in (received, self._load) if each is not None])

    def _begin(self) -> None:
        try:
            plate = load_plate(self._values.bearing)
        except InputError as error:
            raise InputError(
                [f"node follower, parameter 'bearing': {each}" for each in error.problems]
            ) from None
        self._plate = plate
        self._choice: LiveChoice | None = None  # of an estimator that is not stated
        try:
            if self._values.estimator:
                self._follow_by(self._values.estimator)
            else:
                self._choice = LiveChoice(plate)
                self._follow_by(self._choice.estimator)
        except InputError as error:
            problems = [f"node follower, parameter 'estimator': {each}" for each in error.problems]
            raise InputError(problems) from None
        if self._load_received is not None:
            self._load_received.clear()
        self._twin = self._scene_of_twin()
        self._stretches = StretchIntake(self._follower.estimator)
        self._mounting = MountingWatch(self._follower.estimator)
        self._searching: Future[tuple[Mounting, ...]] | None = None
        self._rows: list[Float] = []
        self._latest: Followed | None = None
        self._temperature = math.nan
        self._way = 0.0
        self._compared_at = -math.inf
        self._comparing: Future[Residual] | None = None
        self._residual: Residual | None = None
        self._unread = ""  # why the vibration is not read
        self._trouble = ""  # of the parallel twin
        self._summed_up = False
        self._ended_at: float | None = None

    def _follow_by(self, estimator: Estimator | str) -> None:
        """Begin to follow by an estimator, or its file."""
        self._follower = follower_of(
            self._plate, estimator, service=self._service, axle_loads=self._axle_loads
        )
        known, axes = ", ".join(self._follower.names), ", ".join(self._follower.estimator.axes)
        self.get_logger().info(f"{self._plate.name}: follows {known} by an estimator of the axes {axes}")

    def _scene_of_twin(self) -> Scene | None:
        """Make the scene of the parallel twin, which must be of this bearing and on a track."""
        if not self._values.twin:
            return None
        where = f"node follower, parameter 'twin': scene '{self._values.twin}'"
        try:
            found = make_scene(Path(self._values.twin))
        except InputError as error:
            problems = [f"node follower, parameter 'twin': {each}" for each in error.problems]
            raise InputError(problems) from None
        if not isinstance(found.operation, QuarterVehicleOperation):
            raise InputError(f"{where}: a twin next to a train runs on a track (kind: quarter_vehicle)")
        if doubt := doubt_of(self._follower.estimator, found.bearing):
            raise InputError(f"{where}: {doubt}")
        return found

    # --- what a train has --------------------------------------------------------------------------

    def _receive_vibration(self, time_ns: Int, acceleration: Float) -> None:
        try:
            self._choose_by_axes(acceleration)
            self._stretches.push_vibration(time_ns, acceleration)
            self._unread = ""
        except InputError as error:
            self._unread = str(error)

    def _choose_by_axes(self, acceleration: Float) -> None:
        """Take the estimator of the axes that come, until a stretch has been followed.

        From then on an axis that stays away is a doubt: what is believed belongs to its estimator.
        """
        if self._choice is None or self._follower.stretches:
            return
        estimator = self._choice.take(acceleration)
        if estimator.axes != self._follower.estimator.axes:
            self._follow_by(estimator)
            self._stretches = self._stretches.of(estimator)
            self._mounting = MountingWatch(estimator)

    def _receive_shaft(self, time_ns: Int, angle: Float) -> None:
        self._stretches.push_shaft(time_ns, angle)

    def _receive_temperature(self, _stamp_ns: int, celsius: float) -> None:
        self._temperature = celsius

    # --- what it knows -----------------------------------------------------------------------------

    def _tick(self) -> None:
        self._signals.sweep()
        while (stretch := self._stretches.stretch()) is not None:
            estimator = self._follower.estimator
            row = describe(stretch, estimator.orders, estimator.plate, estimator.axes)
            self._way += abs(stretch.revolutions) * math.pi * self._service.wheel_diameter
            self._follower.know_load(self._load_of(stretch.end_ns))
            self._take(row, 1e-9 * stretch.end_ns)
            self._mounting.take(stretch)
        self._look_at_mounting()
        self._receive_twin()
        if time.monotonic() - self._reported_at > REPORT_PERIOD_S:
            self._report()
        if self._signals.ended and self._worker_is_done() and not self._summed_up:
            self._summed_up = True
            self._numbers.wait_until_received(LAST_VALUES_S)
            self._publish(self._latest, final=True)
            self._report()
            self._out.wait_until_received("follower/estimate", 1.0)
        if self._summed_up or self._signals.vanished:
            self.finished = bool(self._values.exit_when_done)

    def _worker_is_done(self) -> bool:
        """Check whether nothing more is to come of twin and mounting, once the run has ended."""
        self._ended_at = self._ended_at or time.monotonic()
        idle = self._comparing is None and self._searching is None
        return idle or time.monotonic() - self._ended_at > LAST_COMPARISON_S

    def _take(self, row: Float, end: float) -> None:
        earlier = WAITING if self._latest is None else self._latest.health
        step = self._latest = self._follower.take(row, end, self._way)
        self._rows = [*self._rows, row][-KEPT_ROWS:]
        self._numbers.publish(end, follower_values(step))
        self._publish(step)
        if step.health != earlier:
            say = self.get_logger().info if step.health in (WAITING, HEALTHY) else self.get_logger().warning
            say(step.sentence)
        due = end - self._compared_at >= self._values.twin_period
        if self._twin is not None and due and self._comparing is None and step.health != WAITING:
            self._compared_at = end
            known, rows = step.estimates, np.stack(self._rows)
            self._comparing = self._worker.submit(self._compare, self._twin, known, rows)

    def _publish(self, step: Followed | None, final: bool = False) -> None:
        told = {} if step is None else step_object(step)
        self._out.publish("follower/estimate", encode_told({"final": final, **told}))

    def _compare(self, base: Scene, known: Estimates, rows: Float) -> Residual:
        """Run the parallel twin, in the thread of the worker."""
        return residual_beside(self._follower.estimator, rows, known, base, self._values.twin_tier)

    def _look_at_mounting(self) -> None:
        """Search what of the mounting would explain a strange signal, in the thread of the worker."""
        if self._searching is not None and self._searching.done():
            self._mounting.found = self._searching.result()
            self._searching = None
        if self._searching is None and (powers := self._mounting.due()):
            self._searching = self._worker.submit(search_mountings, powers, self._follower.estimator)

    def _receive_twin(self) -> None:
        """Publish what the parallel twin has come to, when it is done."""
        if self._comparing is None or not self._comparing.done():
            return
        done, self._comparing = self._comparing, None
        try:
            self._residual = done.result()
        except (InputError, ValidityError) as error:
            self._trouble = f"twin: {error}"
            self.get_logger().error(self._trouble, throttle_duration_sec=5.0)
            return
        self._trouble = ""
        told = {"time_s": self._compared_at, **residual_object(self._residual)}
        self._out.publish("follower/residual", encode_told(told))

    def _report(self) -> None:
        self._reported_at = time.monotonic()
        namespace = self.get_namespace()
        step = self._latest
        health = WAITING if step is None else step.health
        doubts = () if step is None else step.doubts
        unexplained = () if self._residual is None else self._residual.sentences
        troubles = filter(
            None,
            [
                self._unread or self._stretches.doubt,
                "" if self._load_received is None else self._load_received.doubt,
                self._trouble,
                self._signals.clock_note,
            ],
        )
        mounting = self._mounting.sentence
        told = "; ".join([*doubts, *filter(None, [mounting]), *unexplained, *troubles])
        status = Diagnostic(
            diagnostic_name(namespace, FOLLOWER),
            OK if health in (WAITING, HEALTHY) and not told and not self._signals.guard.total else WARN,
            f"{health}{': ' if told else ''}{told}",
            (
                ("connected", "true" if self._signals.connected else "false"),
                ("health", health),
                ("stretches", str(self._follower.stretches)),
                ("unfit_stretches", str(self._stretches.unfit)),
                ("gaps_in_vibration", str(self._stretches.gaps)),
                ("surprise", "" if step is None else f"{step.surprise:.2f}"),
                ("axes", " ".join(self._follower.estimator.axes)),
                ("mounting", mounting),
                ("temperature", "" if math.isnan(self._temperature) else f"{self._temperature:.1f}"),
                ("explained_by_twin", "" if self._residual is None else f"{self._residual.explained:.3f}"),
                *self._signals.guard.values(),
            ),
        )
        stamp = 0 if step is None else round(1e9 * step.time)
        self._out.publish("/diagnostics", encode_diagnostics(stamp, frame_of(namespace), [status]))

    def close(self) -> bool:
        """Wait for the parallel twin, which is short."""
        self._worker.shutdown(wait=True, cancel_futures=True)
        return False


def main(argv: Sequence[str]) -> int:
    """Run the node until the twin has ended."""
    return run_node(FollowerNode, argv)
