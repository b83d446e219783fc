"""Replays an operation, or a CSV of time, speed and force, as load of the twin.

`lockstep`: stamped blocks with sample numbers on ``load/blocks``, never further ahead of
``load/consumed`` than the horizon; an empty block ends the stream. `live`: one ``load/wrench`` and one
``load/shaft`` a sample, paced by the wall clock. A new run id on ``truth`` (a reset, or another twin)
starts the replay again.

Sample numbers and stamps go on whatever happens; a seek or a loop moves the position in the scenario,
and ``load/truth`` says which stamp stands where. While the node is paused it says so there too, which
keeps the twin from taking the silence for a loss.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

from beardyn_core.base.errors import InputError
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.messages import decode_told, encode_diagnostics, encode_string, header_stamp
from beardyn_core.record.topics import topic
from beardyn_core.scene.load import LONGEST_SPACING_NS, LOOK_AHEAD, LoadHistory
from beardyn_ros.awaited import Awaited
from beardyn_ros.diagnostics import diagnostic_name, run_instance
from beardyn_ros.frames import frame_of
from beardyn_ros.live_load import LowPass, encode_shaft, encode_wrench
from beardyn_ros.message_guard import MessageGuard
from beardyn_ros.node_parameters import PARAMETERS
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.replay import QUICK_S, Credit, Replay, ReplayClock
from beardyn_ros.runtime import EXIT_LOAD_LOST, run_node, wall_timer
from beardyn_ros.scenario import ENDED, PAUSED, PLAYING, Scenario, load_diagnostic, scene_scenario, truth_text
from beardyn_ros.services import StepService
from beardyn_ros.typed_topics import TypedTopics
from beardyn_ros.wire import RawIntake, TopicPublishers

ScenarioLoader = Callable[[str, str, float], Scenario]

LAST_WORDS_TIMEOUT_S = 0.5
HUNG_READER_TIMEOUT_S = 2.0
OTHERS_TIMEOUT_S = 3.0
TWIN_SILENT_AFTER_S = 0.6  # it repeats its credit every 0.2 s
LIVE_RATE_OVER_BANDWIDTH = 5.0
ALONE_TIMEOUT_S = 3.0
SETTLED_AFTER_S = 0.3  # a recorder may be found a moment later than the twin
LOOK_PERIOD_S = 0.1
IDLE_PERIOD_S = 0.2
REPORT_PERIOD_S = 0.5
MOST_BEYOND_NS = 1_000_000_000  # that a twin may have used beyond what was sent: its last block


class LoadNode(Node):
    """Sends a `Scenario`.

    Parameters
    ----------
    load_scenario : callable or None
        ``load_scenario(scene, csv, duration)``; ``None``: scenes of the config room.
    quick : float
        Shortest period in lockstep, [s].
    **of_node
        Passed on to the node: another namespace, parameters.

    Attributes
    ----------
    company : sequence of LoadNode
        Load nodes of the same process that stay together: the slowest of their twins holds back all.
    """

    company: Sequence[LoadNode] = ()

    def __init__(
        self, load_scenario: ScenarioLoader | None = None, quick: float = QUICK_S, **of_node: Any
    ) -> None:
        super().__init__("load", **{"namespace": "axlebox", **of_node})
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS["load"])
        values = self._values
        self._frame = frame_of(self.get_namespace(), values.frame_id)
        if values.block >= values.horizon:
            raise InputError(
                f"node load: block {values.block:g} s must be shorter than horizon {values.horizon:g} s"
            )
        loader = load_scenario or scene_scenario
        self._scenario = loader(values.scene, values.csv, values.duration)
        self._replay = Replay(self._scenario.history, values.loop, values.fade, values.position)
        self._live = values.mode == "live"
        self._live_clock = ReplayClock(self._pace)
        self._paused = False
        self._steps_left = 0
        self._run_id = self._next_run_id = ""
        self._credit = Credit()
        self._out = TopicPublishers(
            self,
            "load/blocks",
            "load/truth",
            "/diagnostics",
            *(("load/wrench", "load/shaft") if self._live else ()),
            typed=TypedTopics.wanted(self, values.typed, self._frame),
        )
        self._restart()
        self._intake = RawIntake(self, polled=True)
        self._guard = MessageGuard(self)
        consumed = topic("load/consumed")
        self._intake.add_sourced(
            consumed, self._guard.guard_handler(consumed, self._on_consumed), keep_all=False
        )
        self._runs = RawIntake(self)
        truth = topic("truth")
        self._runs.add_sourced(truth, self._guard.guard_handler(truth, self._on_truth))
        self._awaited = Awaited(self, values.wait_for)
        self._announced = False
        self._listeners: tuple[int, ...] = ()
        self._listeners_since = time.monotonic()
        self._connected = False
        self._looked_at = 0.0
        self._alone_since = self._twinless_since = time.monotonic()
        self.get_logger().info(
            f"{len(self._scenario.history)} load samples over {self._replay.length_s:.2f} s, "
            "waiting for a twin"
        )
        self._quick_s = 1.0 / values.live_rate if self._live else quick
        self._timer = wall_timer(self, IDLE_PERIOD_S, self._on_timer)
        wall_timer(self, REPORT_PERIOD_S, self._report)
        self.create_service(SetBool, "load/pause", self._on_pause)
        self._steps = StepService(
            self, "load/step", self._order_step, f"one block of {values.block:g} s is sent"
        )
        self.create_service(Trigger, "load/reset", self._on_reset)
        self.add_on_set_parameters_callback(self._refuse_change)
        self.add_post_set_parameters_callback(self._on_parameters)

    @property
    def _pace(self) -> float:
        return float(self._values.speed_factor) or 1.0

    @property
    def _state(self) -> str:
        if self._ended:
            return ENDED
        return PAUSED if self._paused else PLAYING

    def _restart(self) -> None:
        self._replay.restart()
        self._live_clock.restart()
        self._new_live_filter()
        self._unsent: tuple[LoadHistory, int] | None = None
        self._ended = False
        self._credit.begin(self._replay.next_ns)
        self._published_truth: tuple[object, ...] = ()
        self._publish_truth()

    def _new_live_filter(self) -> None:
        """Begin to filter what is sampled; the rate is one of wall time, the filter works in the load's."""
        self._live_filter = LowPass(self._values.live_rate / (LIVE_RATE_OVER_BANDWIDTH * self._pace))
        self._live_last_ns = -1

    def _on_consumed(self, cdr: bytes) -> None:
        credit_ns = header_stamp(cdr)
        if not self._live and credit_ns > self._replay.next_ns + MOST_BEYOND_NS:
            self._guard.refuse(
                "load/consumed",
                f"it gives credit until {credit_ns / 1e9:.6g} s; load is sent until "
                f"{self._replay.next_ns / 1e9:.6g} s",
            )
        else:
            self._credit.receive(credit_ns)

    def _on_truth(self, cdr: bytes) -> None:
        run_id = self._next_run_id = str(decode_told(cdr).get("run_id", ""))
        same_twin = run_instance(run_id) == run_instance(self._run_id)
        if same_twin or not self._run_id:
            self._follow_run()

    def _follow_run(self) -> None:
        """Serve the run that was announced last, from the start when it is another one."""
        known, self._run_id = self._run_id, self._next_run_id
        if known and self._run_id != known:
            self.get_logger().info("a new run has begun, the replay starts again")
            self._restart()
        self._publish_truth()

    def _follow_the_next_twin(self) -> None:
        """Serve another twin as soon as the one served so far is silent: two cannot feed on one stream."""
        silent = time.monotonic() - self._credit.received_at > TWIN_SILENT_AFTER_S
        if self._next_run_id != self._run_id and silent:
            self._follow_run()

    # --- services and parameters -------------------------------------------------------------------

    def _on_pause(self, request: Any, response: Any) -> Any:
        self._paused, self._steps_left = bool(request.data), 0
        self._steps.fail("the load was paused anew" if request.data else "the load plays on")
        self._live_clock.pause(self._paused)
        self._publish_truth()
        self._on_timer()
        response.success, response.message = True, self._state
        return response

    def _order_step(self) -> str:
        if self._live:
            return "a step is one block of load, which only lockstep has"
        if self._ended:
            return "the stream has ended"
        if not self._paused:
            return "the load is playing: call load/pause with true first"
        self._steps_left += 1
        self._look_again_in(self._quick_s)
        return ""

    def _on_reset(self, _request: Any, response: Any) -> Any:
        if self._ended:
            response.success, response.message = False, "the stream has ended: call reset of the twin"
        else:
            self._replay.seek(0.0)
            response.success, response.message = True, "the scenario starts again, stamps go on"
        return response

    def _refuse_change(self, changes: Sequence[Any]) -> Any:
        from rcl_interfaces.msg import SetParametersResult

        problem = ""
        for change in changes:
            if change.name == "position":
                problem = problem or self._replay.problem_of_seek(change.value)
            elif change.name == "loop":
                problem = problem or self._replay.problem_of_loop(change.value)
            if change.name in ("position", "loop") and self._ended:
                problem = problem or "the stream has ended: only a reset of the twin starts another"
        return SetParametersResult(successful=not problem, reason=problem)

    def _on_parameters(self, changes: Sequence[Any]) -> None:
        for change in changes:
            if change.name == "position":
                self._replay.seek(change.value)
            elif change.name == "loop":
                self._replay.loop = change.value
                self._publish_truth()
            elif change.name == "speed_factor":
                self._live_clock.set_pace(self._pace)
                self._new_live_filter()

    # --- replay ------------------------------------------------------------------------------------

    def _publish_truth(self) -> None:
        """Publish the truth when it has changed: always before the load that it is about."""
        now = (self._state, self._run_id, self._replay.loop, len(self._replay.passages))
        if now != self._published_truth:
            text = truth_text(self._scenario, self._replay, self._state, self._run_id)
            self._out.publish("load/truth", encode_string(text))
            self._published_truth = now

    def _report(self) -> None:
        name = diagnostic_name(self.get_namespace(), "load")
        lead = (self._replay.next_ns - self._credit.time_ns) * 1e-9
        sent = {each: self._out.sent[each] for each in self._out.names if each != "/diagnostics"}
        status = load_diagnostic(
            name, self._state, self._replay, lead, self._out.lost_messages, sent, self._guard
        )
        hardware = frame_of(self.get_namespace())
        self._out.publish("/diagnostics", encode_diagnostics(self._credit.time_ns, hardware, [status]))
        self._steps.fail_late("the block is not sent yet: it waits for the twin to take what it has")

    def _on_timer(self) -> None:
        self._intake.sweep()
        self._follow_the_next_twin()
        (self._pump_live if self._live else self._pump)()
        rests = self._paused and not self._steps_left
        idle = not self._announced or rests or (self._ended and not self._values.exit_when_done)
        self._look_again_in(IDLE_PERIOD_S if idle else self._busy_period())

    def _busy_period(self) -> float:
        """Choose when to send again: at the live rate, or in time for the twin, [s]."""
        if self._live:
            return self._quick_s
        return self._credit.look_period(self._values.horizon - self._values.block, self._quick_s)

    def _look_again_in(self, period: float) -> None:
        """Let the timer tick with a period, [s]."""
        period_ns = round(period * 1e9)
        if self._timer.timer_period_ns != period_ns:
            self._timer.timer_period_ns = period_ns
            self._timer.reset()

    def _twin_listens(self) -> bool:
        """Check whether the twin gets what is sent; looked up at intervals, it costs more than a send."""
        now = time.monotonic()
        if now - self._looked_at < LOOK_PERIOD_S:
            return self._connected
        self._looked_at = now
        self._connected = self._all_connected() and (
            self._announced or now - self._listeners_since > SETTLED_AFTER_S
        )
        if self._connected and not self._announced:
            self._announced = True
            self.get_logger().info("the twin is ready, replay begins")
        if self._connected or not self._announced or self._ended:
            self._alone_since = now
        elif self._values.exit_when_done and now - self._alone_since > ALONE_TIMEOUT_S:
            self.get_logger().error("the twin has gone before everything was replayed")
            self.exit_code, self.finished = EXIT_LOAD_LOST, True
        timeout = self._values.start_timeout
        if not self._announced and 0.0 < timeout < now - self._twinless_since:
            self.get_logger().error(
                f"there has been no twin in {self.get_namespace()} for start_timeout = {timeout:g} s"
            )
            self.exit_code, self.finished = EXIT_LOAD_LOST, True
        return self._connected

    def _all_connected(self) -> bool:
        """Check whether the twin, and every other listener that the graph knows, is connected.

        Recorder and monitor listen to the load too; the twin is the one that gives credit. The others
        are waited for in the beginning only, and not for ever: one may hang, or ask for another QoS.
        """
        names = ("load/wrench", "load/shaft", "load/blocks") if self._live else ("load/blocks",)
        counts = tuple(self._out.publisher(name).get_subscription_count() for name in names)
        if counts != self._listeners:
            self._listeners, self._listeners_since = counts, time.monotonic()
        givers = self.get_publishers_info_by_topic(self.resolve_topic_name("load/consumed"))
        twins = {(info.node_namespace, info.node_name) for info in givers}
        if twins:
            self._twinless_since = time.monotonic()
        for name, count in zip(names, counts, strict=True):
            known = self.get_subscriptions_info_by_topic(self.resolve_topic_name(name))
            patient = not self._announced and time.monotonic() - self._listeners_since < OTHERS_TIMEOUT_S
            if count == 0 or (patient and count < len(known)):
                return False
            if not twins & {(info.node_namespace, info.node_name) for info in known}:
                return False
        return self._announced or self._awaited.are_there()

    def _latest_credit(self) -> int:
        """Find the time up to which the load is used, from where the horizon counts, [ns]."""
        return min((each._credit.time_ns for each in self.company), default=self._credit.time_ns)

    def _pump(self) -> None:
        if not (self._twin_listens() or self._ended):
            return
        # what the twin looks ahead comes on top, or a short horizon would leave both waiting
        looked_ahead_ns = LOOK_AHEAD * min(self._replay.spacing_ns, LONGEST_SPACING_NS)
        latest_ns = self._latest_credit() + round(self._values.horizon * 1e9) + looked_ahead_ns
        while not self._ended and (not self._paused or self._steps_left):
            if self._unsent is None:
                first = self._replay.next_sample
                until_ns = self._replay.next_ns + round(self._values.block * 1e9)
                self._unsent = self._replay.take(max(self._replay.samples_before(until_ns), 1)), first
                self._publish_truth()
            load, first = self._unsent
            if len(load) == 0:
                self._end_stream()
                return
            if load.time_ns[-1] > latest_ns or not self._out.publish(
                "load/blocks", encode_load(load, first, self._frame)
            ):
                return
            self._unsent = None
            if self._steps_left:
                self._steps_left -= 1
                self._steps.complete()
        if self._ended:
            self._end_stream()

    def _pump_live(self) -> None:
        if not (self._twin_listens() or self._ended):
            return
        self._live_clock.start()
        if not self._ended:
            now_ns = int(self._scenario.history.time_ns[0]) + int(self._live_clock.passed() * 1e9)
            load = self._replay.take(self._replay.samples_before(now_ns + 1))
            self._publish_truth()
            if len(load):
                stamp, filtered = int(load.time_ns[-1]), self._filter_since_last(load)
                self._out.publish("load/wrench", encode_wrench(filtered[:6], stamp, self._frame))
                self._out.publish("load/shaft", encode_shaft(float(filtered[6]), stamp, self._frame))
            if not self._replay.exhausted:
                return
        self._end_stream()

    def _filter_since_last(self, load: LoadHistory) -> NDArray[np.float64]:
        """Filter the samples since the last message: wrench and speed at the last of them, shape [7]."""
        before = self._live_last_ns if self._live_last_ns >= 0 else int(load.time_ns[0]) - 1
        steps = np.diff(load.time_ns, prepend=before) * 1e-9
        self._live_last_ns = int(load.time_ns[-1])
        return self._live_filter.push(steps, np.column_stack([load.wrench, load.shaft_speed]))

    def _end_stream(self) -> None:
        if not self._ended:
            empty = self._scenario.history.part(0, 0)
            self._ended = self._out.publish(
                "load/blocks", encode_load(empty, self._replay.next_sample, self._frame)
            )
            self._credit.changed_at = time.monotonic()
            self._publish_truth()
            self._report()
            self._steps.fail("the stream has ended")
            self.get_logger().info("everything is replayed, the stream is ended")
        elif self._values.exit_when_done:
            # The twin still reads: leaving before it has everything would lose the tail. When it has taken
            # nothing for a while, whoever has not confirmed yet hangs.
            listeners = self._out.publisher("load/blocks").get_subscription_count()
            hung = time.monotonic() - self._credit.changed_at > HUNG_READER_TIMEOUT_S
            self.finished = listeners == 0 or hung or self._out.wait_until_received("load/blocks", 0.001)

    def close(self) -> bool:
        """Publish the last word; there is no thread to end."""
        self._report()
        self._out.wait_until_received("/diagnostics", LAST_WORDS_TIMEOUT_S)
        return False


def main(argv: Sequence[str], load_scenario: ScenarioLoader | None = None) -> int:
    """Run the node until everything is replayed."""
    return run_node(lambda: LoadNode(load_scenario), argv)
