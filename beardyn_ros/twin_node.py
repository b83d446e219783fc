"""The lifecycle node of the twin.

Services: ``~/../pause`` (SetBool), ``step`` and ``reset`` (Trigger), all in
the node's namespace. Exit codes: `beardyn_ros.runtime.EXIT_CODES`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from std_srvs.srv import SetBool, Trigger

from beardyn_core.base.errors import InputError
from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.messages import encode_clock, encode_time
from beardyn_core.record.topics import topic
from beardyn_ros.diagnostics import TWIN, Namesakes, diagnostic_name
from beardyn_ros.frames import frame_of
from beardyn_ros.load_intake import LoadIntake
from beardyn_ros.message_guard import Sources
from beardyn_ros.node_parameters import PARAMETERS
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.rig import Rig, lone_box_rig, scene_rig
from beardyn_ros.robot_description import DescriptionPublisher
from beardyn_ros.run_state import END_STATES, FINISHED, LEFT, PAUSED, Outgoing, SessionOptions
from beardyn_ros.runtime import EXIT_BAD_INPUT, run_node, wall_timer
from beardyn_ros.services import SimulationServices, StepService, interfaces
from beardyn_ros.session import TwinSession
from beardyn_ros.source_time import follows_source
from beardyn_ros.twin_report import TwinReporter, needs_attention, pace_sentence
from beardyn_ros.typed_topics import TypedTopics
from beardyn_ros.wire import RawIntake, Spreader, TopicPublishers

RigLoader = Callable[[str, str, str], Callable[[], Rig]]

REPORT_PERIOD_S = 0.2
LAST_WORDS_TIMEOUT_S = 2.0
THREAD_END_TIMEOUT_S = 2.0
SLOW_READER_TIMEOUT_S = 1.0
READERS_IGNORED_S = 5.0
SETTLED_AFTER_S = 1.0  # before a run begins: a twin of the same name would have spoken by then
NAMESAKE_TIMEOUT_S = 1.5  # the same when the graph knows another publisher, which may have died
TRENDS_TIMEOUT_S = 0.1
TRUTH_TIMEOUT_S = 0.5
BLOCKS_BEFORE_CONFIRMATION = 10  # of more than 100 that the shallowest history holds
SIGNAL_TOPICS = (
    "force",
    "force_waveform",
    "vibration",
    "imu",
    "shaft",
    "joint_states",
    "bodies",
    "contacts",
)


class TwinNode(LifecycleNode):
    """Publishes what a `TwinSession` simulates.

    Parameters
    ----------
    load_rig : callable or None
        Gives, for ``scene``, ``tier`` and ``effects``, a builder of rigs; ``None``: scenes.
    **of_node
        For one of several in a process: namespace, parameters.
    """

    def __init__(self, load_rig: RigLoader | None = None, **of_node: Any) -> None:
        super().__init__("twin", **{"namespace": "axlebox", **of_node})
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS["twin"])
        self._load_rig = load_rig or self._rig_of_scene
        self._frame = frame_of(self.get_namespace(), self._values.frame_id)
        self._description = DescriptionPublisher(self, self._frame, self._values)
        self._name = diagnostic_name(self.get_namespace(), TWIN)
        self._namesakes = Namesakes(self._name)
        self._born = time.monotonic()
        self._settled = self._wanted_active = self._over = False
        self._refused_at = 0.0
        self._session: TwinSession | None = None
        self._consumed_ns: int | None = None
        self._clock_ns = 0
        self._announced = self._load_lacks = self._tier_note = ""
        self._readers_ignored_until = 0.0
        self._blocks_unconfirmed = 0
        typed = TypedTopics.wanted(self, self._values.typed, self._frame)
        self._out = TopicPublishers(
            self, "truth", *SIGNAL_TOPICS, "load/consumed", "/diagnostics", typed=typed
        )
        if self._publishes_clock:
            self._out.publisher("/clock")
        self._trends = Spreader(self._out.publish)
        self._load = LoadIntake(self, self._frame)
        self._reporter = TwinReporter(self, self._values, self._namesakes, self._load, self._out)
        self._namesake_intake = RawIntake(self, polled=True)
        self._namesake_intake.add_sourced(topic("/diagnostics"), self._on_diagnostics, keep_all=False)
        self._checker, self._sources = MessageChecker(), Sources(self)
        self._guard = self.create_guard_condition(self._publish_waiting)
        wall_timer(self, REPORT_PERIOD_S, self._on_timer)
        self.create_service(SetBool, "pause", self._on_pause)
        self._steps = StepService(self, "step", self._order_step, "one block of 20 ms is published")
        self.create_service(Trigger, "reset", self._on_reset)
        self._simulation = SimulationServices(
            self, lambda: self._session, self._reset, self._quit, interfaces()
        )
        self.add_post_set_parameters_callback(self._on_parameters)
        if self._values.autostart:
            self._autostart = wall_timer(self, 0.0, self._start_up)

    # --- lifecycle ---------------------------------------------------------------------------------

    def _start_up(self) -> None:
        self._autostart.cancel()
        if self.trigger_configure() == TransitionCallbackReturn.SUCCESS:
            self.trigger_activate()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Read the scene and start compiling it in the background."""
        values = self._values
        try:
            make_rig = self._load_rig(values.scene, values.tier, values.effects)
        except InputError as error:
            for sentence in error.problems:
                self.get_logger().error(sentence)
            if values.autostart:
                self.exit_code, self.finished = EXIT_BAD_INPUT, True
            return TransitionCallbackReturn.FAILURE
        options = SessionOptions(
            mode=values.mode,
            load_timeout=values.load_timeout,
            start_timeout=values.start_timeout,
            max_age=values.max_age,
            queue_ns=round(values.load_queue * 1e9),
            queue_bytes=round(values.load_queue_size * 1e6),
            join=values.join,
            live_bandwidth=values.live_bandwidth,
            frame=self._frame,
            instance=self._namesakes.instance,
            of_source=self._of_source,
        )
        self._session = TwinSession(make_rig, options, self._speed_factor, self._guard.trigger)
        self._load.serve(self._session.feed, live=values.mode == "live")
        self._session.compile()
        return super().on_configure(state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run, as soon as the scene is compiled and load is there."""
        self._wanted_active = True
        self._settle()
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hold before the next block."""
        assert self._session is not None
        self._wanted_active = False
        self._session.activate(False)
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget the twin; a new configure reads the scene again."""
        self._end_session("the twin was cleaned up by its lifecycle")
        return super().on_cleanup(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End the process."""
        self._end_session("the twin was shut down by its lifecycle")
        self.finished = True
        return super().on_shutdown(state)

    def close(self) -> bool:
        """Publish the last state and end the thread; whether the thread is still alive."""
        alive = self._end_session("the twin was asked to stop (SIGINT or SIGTERM)")
        self._trends.end()
        return alive

    def _end_session(self, why: str) -> bool:
        """End the run with a last word, unless it has had one; whether its thread is still alive."""
        session = self._session
        if session is None:
            return False
        self._steps.fail(why)
        alive = session.end(THREAD_END_TIMEOUT_S)
        if not self.finished:
            for outgoing in session.collect():
                self._publish(outgoing)
            session.interrupt(why)
            self._trends.drain(TRENDS_TIMEOUT_S)
            self._reporter.tell_left_run(session, self._clock_ns)
            self._over = True
            self._log_pace(session)
            self._report()
            self._flush()
        self._load.serve(None)
        self._session, self._consumed_ns = None, None
        self._simulation.look()
        return alive

    def _on_diagnostics(self, cdr: bytes, source: bytes) -> None:
        """Listen for other twins of this name; what cannot be read, or only claims the name, is refused."""
        problem = self._checker.problem(topic("/diagnostics"), cdr)
        reason = "wrong fields"
        if not problem and self._namesakes.is_named_in(cdr):
            reason, problem = "foreign status", self._sources.problem_of_name(source)
        if not problem:
            self._namesakes.receive(cdr)
        elif self._session is not None:
            self._session.feed.gate.refuse(reason, problem, "/diagnostics")

    def _settle(self) -> None:
        """Let a run begin as soon as no other twin of this name is to be expected.

        One that refuses to run says so for a while, for its status may not reach the first twin before.
        """
        if self._namesakes.older and not self.finished and not self._refused_at:
            self._refused_at = time.monotonic()
            self.get_logger().error(
                f"there is a twin {self._name} already: two of them would feed on one load and publish on "
                "the same topics; give this one a namespace of its own (-r __ns:=/left)"
            )
        if self._refused_at:
            told = time.monotonic() - self._refused_at > SETTLED_AFTER_S
            self.exit_code, self.finished = EXIT_BAD_INPUT, self.finished or told
            return
        if not self._settled:
            others = self.count_publishers(self.resolve_topic_name("truth")) > 1
            wait = NAMESAKE_TIMEOUT_S if others else SETTLED_AFTER_S
            self._settled = time.monotonic() - self._born > wait
        if self._settled and self._wanted_active and self._session is not None and not self.finished:
            self._session.activate(True)

    # --- services ----------------------------------------------------------------------------------

    def _on_pause(self, request: Any, response: Any) -> Any:
        if self._session is None:
            response.success, response.message = False, "the twin is not configured"
        else:
            self._session.pause(request.data)
            self._steps.fail("the twin was paused anew" if request.data else "the twin runs on")
            response.success, response.message = True, "paused" if request.data else "running on"
        return response

    def _order_step(self) -> str:
        return "the twin is not configured" if self._session is None else self._session.step() or ""

    def _on_reset(self, _request: Any, response: Any) -> Any:
        problem = self._reset()
        done = "the scene starts again at t = 0 with a new recording"
        response.success, response.message = not problem, problem or done
        return response

    def _reset(self, why: str = "") -> str:
        """Start the scene again, for a reason that the last word of the run gives; why not, if it cannot."""
        if self._session is None:
            return "the twin is not configured"
        report = self._session.report()
        problem = self._session.reset() or ""
        if not problem:
            self._consumed_ns = None
            self._reporter.leave(report, why)
            self._steps.fail(LEFT)
        return problem

    def _quit(self) -> None:
        """End the process as SIGINT does."""
        self._end_session("the twin was asked to quit")
        self.finished = True

    @property
    def _of_source(self) -> bool:
        """Whether stamps are those of the source of the load."""
        return follows_source(self._values.stamps, self._values.mode)

    @property
    def _publishes_clock(self) -> bool:
        """Whether this node publishes /clock: a train has a clock of its own."""
        asked = self._values.publish_clock
        return bool(asked == "true" or (asked == "auto" and not self._of_source))

    def _rig_of_scene(self, scene: str, tier: str, effects: str) -> Callable[[], Rig]:
        box, pace = self._values.box, self._speed_factor
        if box:
            return lone_box_rig(box, pace)(scene, tier, effects)
        return scene_rig(scene, tier, effects, pace=pace)

    @property
    def _speed_factor(self) -> float:
        """Pace of the run; live load needs a clock, so there 0 means real time."""
        factor = float(self._values.speed_factor)
        return factor or (1.0 if self._values.mode == "live" else 0.0)

    def _on_parameters(self, changes: Sequence[Any]) -> None:
        for change in changes:
            if change.name == "speed_factor" and self._session is not None:
                self._session.pacer.set_speed_factor(self._speed_factor)

    # --- publishing --------------------------------------------------------------------------------

    def _publish_waiting(self) -> None:
        if self._session is None:
            return
        report = self._session.report()
        for outgoing in self._session.collect():
            self._publish(outgoing)
        if self._session.new_run_wanted:
            why = self._session.new_run_wanted
            self.get_logger().warning(f"{why}: a new run begins")
            self._reset(why)
        if report.load_lacks != self._load_lacks:
            self._load_lacks = report.load_lacks
            if report.load_lacks:
                self.get_logger().warning(report.load_lacks)
        if report.tier_note != self._tier_note:
            self._tier_note = report.tier_note
            self.get_logger().info(report.tier_note)
        sentence = f"{report.state}: {report.sentence}"
        if needs_attention(report) and sentence != self._announced:
            if self._session.exit_code:
                self.get_logger().error(sentence)
            else:
                self.get_logger().info(sentence)
        if sentence != self._announced:
            self._announced = sentence
            self._report()
        self._simulation.look()
        if report.state in END_STATES and not self.finished:
            self._finish(report.state)

    def _publish(self, outgoing: Outgoing) -> None:
        assert self._session is not None
        if outgoing.clock_ns is None:  # the truth of a new run
            self._trends.flush()
            self._reporter.tell_left_run(self._session, self._clock_ns)
            self._out.sent.clear()
            self._consumed_ns, self._clock_ns, self._over = None, 0, False
        for name, cdr in outgoing.messages:
            self._out.publish(name, cdr)
        trends = ((name, cdr) for _, name, cdr in outgoing.trends)
        self._description.follow((*outgoing.messages, *trends))
        if outgoing.clock_ns is None:
            if self._of_source:  # its readers must know the run before its stamps come
                self._out.wait_until_received("truth", TRUTH_TIMEOUT_S)
            self._session.confirm_truth()
            return
        self._session.pacer.check_published(outgoing.clock_ns, outgoing.due_at)
        self._trends.spread(outgoing.trends, self._speed_factor)
        self._clock_ns, self._consumed_ns = outgoing.stamp_ns, outgoing.consumed_ns
        if self._publishes_clock:
            self._out.publish("/clock", encode_clock(outgoing.stamp_ns))
        self._out.publish("load/consumed", encode_time(outgoing.consumed_ns))
        if outgoing.ordered:
            self._trends.drain(TRENDS_TIMEOUT_S)
            self._steps.complete()
        self._blocks_unconfirmed += 1
        tied_to_a_clock = 0.0 < self._speed_factor <= 1.0
        if self._blocks_unconfirmed >= BLOCKS_BEFORE_CONFIRMATION and not tied_to_a_clock:
            self._wait_for_readers()

    def _wait_for_readers(self) -> None:
        """Wait for the readers in a run without pace or faster than real time: nothing is overwritten.

        A reader that has died must not hold the twin, so its silence is believed for a while.
        """
        self._blocks_unconfirmed = 0
        if time.monotonic() < self._readers_ignored_until:
            return
        for name in SIGNAL_TOPICS:
            if not self._out.wait_until_received(name, SLOW_READER_TIMEOUT_S):
                self._readers_ignored_until = time.monotonic() + READERS_IGNORED_S
                return

    def _on_timer(self) -> None:
        self._namesake_intake.sweep()
        self._settle()
        self._report()
        if self._session is None:
            return
        report = self._session.report()
        stands = report.state == PAUSED or self._over
        if stands and report.blocks and self._publishes_clock:
            self._out.publish("/clock", encode_clock(self._clock_ns))
        if report.state in END_STATES and self._over:  # an ordered block may be about to be published
            self._steps.fail(f"the run is {report.state}: {report.sentence}")
        self._steps.fail_late("the block is not done yet: it waits for load that covers it")

    def _report(self) -> None:
        if self._consumed_ns is not None:
            self._out.publish("load/consumed", encode_time(self._consumed_ns))
        if self._session is None:
            return
        report = self._session.report()
        if report.state in END_STATES and not self._over:
            return  # the last word comes when everything else is out: it counts the messages
        self._reporter.tell(self._session, report, self._clock_ns)

    def _finish(self, state: str) -> None:
        """Finish the run: publish everything, then the last report, then rest or end."""
        assert self._session is not None
        for outgoing in self._session.collect():
            self._publish(outgoing)
        self._trends.drain(TRENDS_TIMEOUT_S)
        self._flush()
        self._over = True
        self._log_pace(self._session)
        self._report()
        self._out.wait_until_received("/diagnostics", LAST_WORDS_TIMEOUT_S)
        if self._values.exit_when_done:
            self.exit_code = self._session.exit_code
            self.trigger_deactivate()
            self.finished = True
        elif state == FINISHED:
            self.get_logger().info("finished; the service reset starts the scene again")

    def _log_pace(self, session: TwinSession) -> None:
        if sentence := pace_sentence(session.report(), self._speed_factor):
            self.get_logger().info(sentence)

    def _flush(self) -> None:
        deadline = time.monotonic() + LAST_WORDS_TIMEOUT_S
        for name in self._out.names:
            self._out.wait_until_received(name, max(deadline - time.monotonic(), 0.0))


def main(argv: Sequence[str], load_rig: RigLoader | None = None) -> int:
    """Run the node until the run is over."""
    return run_node(lambda: TwinNode(load_rig), argv)
