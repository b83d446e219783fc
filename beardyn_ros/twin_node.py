"""The lifecycle node of the twin.

Parameters: `PARAMETERS`. Services: ``~/../pause`` (SetBool), ``step`` and ``reset`` (Trigger), all in
the node's namespace. Exit codes: `beardyn_ros.runtime.EXIT_CODES`.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from std_srvs.srv import SetBool, Trigger

from beardyn_core.errors import InputError
from beardyn_core.record.load_stream import decode_load
from beardyn_core.record.messages import (
    decode,
    decode_string,
    encode_clock,
    encode_diagnostics,
    encode_time,
    header_stamp,
)
from beardyn_core.record.published import published_values
from beardyn_core.record.topics import FRAME, TWIST, WRENCH, topic
from beardyn_ros.diagnostics import diagnostic_name, needs_attention, twin_diagnostic
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.run_state import END_STATES, FINISHED, Outgoing, Rig, SessionOptions, scene_rig
from beardyn_ros.runtime import EXIT_BAD_INPUT, run_node
from beardyn_ros.scenario import says_paused
from beardyn_ros.session import TwinSession
from beardyn_ros.wire import RawIntake, TopicPublishers

RigLoader = Callable[[str], Callable[[], Rig]]

REPORT_PERIOD_S = 0.2
LAST_WORDS_TIMEOUT_S = 2.0
THREAD_END_TIMEOUT_S = 2.0
SLOW_READER_TIMEOUT_S = 1.0
READERS_IGNORED_S = 5.0
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

PARAMETERS = (
    NodeParameter("scene", "cup_spall", "shipped scene by name, or path of a scene file"),
    NodeParameter(
        "mode",
        "lockstep",
        "lockstep waits for load/blocks; live holds the last load/wrench and load/shaft, whose stamps may "
        "be of any one clock as long as they increase",
        choices=("lockstep", "live"),
    ),
    NodeParameter(
        "speed_factor",
        0.0,
        "simulated seconds per wall second, 1 is real time, 0 is as fast as it goes (in live mode: 1); "
        "in lockstep the results do not depend on it",
        minimum=0.0,
        maximum=1000.0,
        live=True,
    ),
    NodeParameter("autostart", True, "configure and activate at once, without a lifecycle manager"),
    NodeParameter(
        "exit_when_done", True, "end the process when the load stream has ended or the run has stopped"
    ),
    NodeParameter(
        "start_timeout", 120.0, "longest wait for the first load, 0 for ever", "s", minimum=0.0, maximum=1e6
    ),
    NodeParameter(
        "load_timeout",
        10.0,
        "longest wait for load that stopped coming in lockstep, 0 for ever",
        "s",
        minimum=0.0,
        maximum=1e6,
    ),
    NodeParameter(
        "max_age", 0.5, "oldest load that the live mode may hold", "s", minimum=0.02, maximum=3600.0
    ),
    NodeParameter(
        "load_queue",
        120.0,
        "load that may wait; more is an error that ends the run",
        "s",
        minimum=0.1,
        maximum=3600.0,
    ),
    NodeParameter(
        "load_queue_size",
        256.0,
        "memory that waiting load may take, 88 bytes a sample",
        "MB",
        minimum=0.1,
        maximum=16_384.0,
    ),
    NodeParameter("publish_clock", True, "publish /clock; one twin of several"),
)


class TwinNode(LifecycleNode):
    """Publishes what a `TwinSession` simulates.

    Parameters
    ----------
    load_rig : callable or None
        Gives, for the parameter ``scene``, a builder of rigs; ``None``: scenes of the config room.
    """

    def __init__(self, load_rig: RigLoader | None = None) -> None:
        super().__init__("twin", namespace="axlebox")
        self.finished = False
        self.exit_code = 0
        self._load_rig = load_rig or scene_rig
        self._values = ParameterValues(self, PARAMETERS)
        self._session: TwinSession | None = None
        self._load_paused = False
        self._consumed_ns: int | None = None
        self._clock_ns = 0
        self._announced = ""
        self._messages_of_run: Counter[str] = Counter()
        self._all_published = False
        self._readers_ignored_until = 0.0
        self._blocks_unconfirmed = 0
        self._out = TopicPublishers(self, "truth", *SIGNAL_TOPICS, "load/consumed", "/diagnostics")
        if self._values.publish_clock:
            self._out.publisher("/clock")
        self._intake = RawIntake(self)
        self._guard = self.create_guard_condition(self._publish_waiting)
        self.create_timer(REPORT_PERIOD_S, self._report)
        self.create_service(SetBool, "pause", self._on_pause)
        self.create_service(Trigger, "step", self._on_step)
        self.create_service(Trigger, "reset", self._on_reset)
        self.add_post_set_parameters_callback(self._on_parameters)
        if self._values.autostart:
            self._autostart = self.create_timer(0.0, self._start_up)

    # --- lifecycle ---------------------------------------------------------------------------------

    def _start_up(self) -> None:
        self._autostart.cancel()
        if self.trigger_configure() == TransitionCallbackReturn.SUCCESS:
            self.trigger_activate()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Read the scene and start compiling it in the background."""
        values = self._values
        try:
            make_rig = self._load_rig(values.scene)
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
        )
        self._session = TwinSession(make_rig, options, self._speed_factor, self._guard.trigger)
        if not self._intake.publisher_counts():
            self._intake.add(topic("load/blocks"), self._on_load)
            self._intake.add(topic("load/truth"), self._on_load_truth)
            if values.mode == "live":
                self._intake.add(topic("load/wrench"), self._on_wrench)
                self._intake.add(topic("load/shaft"), self._on_shaft)
        self._session.feed.pause(self._load_paused)
        self._session.compile()
        return super().on_configure(state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run, as soon as the scene is compiled and load is there."""
        assert self._session is not None
        self._session.activate(True)
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Hold before the next block."""
        assert self._session is not None
        self._session.activate(False)
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget the twin; a new configure reads the scene again."""
        self._end_session()
        return super().on_cleanup(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End the process."""
        self._end_session()
        self.finished = True
        return super().on_shutdown(state)

    def close(self) -> bool:
        """Publish the last state and end the thread; whether the thread is still alive."""
        if self._session is None:
            return False
        if not self.finished:
            self._publish_waiting()
            self._report()
            self._flush()
        return self._end_session()

    def _end_session(self) -> bool:
        session, self._session = self._session, None
        self._consumed_ns = None
        return session.end(THREAD_END_TIMEOUT_S) if session is not None else False

    # --- load --------------------------------------------------------------------------------------

    def _on_load(self, cdr: bytes) -> None:
        if self._session is None:
            return
        try:
            load, samples = decode_load(cdr)
        except Exception as error:  # a foreign message may break the decoder in any way
            refusal: str | None = self._session.feed.gate.refuse(
                "wrong fields",
                "it is not a block of load samples with the fields sample, t, fx..mz, shaft_speed "
                f"({error!r})",
            )
        else:
            refusal = self._session.feed.gate.offer(load, samples)
        self._report_refusal(refusal)

    def _on_load_truth(self, cdr: bytes) -> None:
        self._load_paused = says_paused(decode_string(cdr))
        if self._session is not None:
            self._session.feed.pause(self._load_paused)

    def _on_wrench(self, cdr: bytes) -> None:
        if self._session is None:
            return
        content = decode(WRENCH, cdr).wrench
        force, torque = content.force, content.torque
        wrench = np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])
        self._report_refusal(self._session.feed.live.offer_wrench(wrench, header_stamp(cdr)))

    def _on_shaft(self, cdr: bytes) -> None:
        if self._session is None:
            return
        speed = float(decode(TWIST, cdr).twist.angular.y)
        self._report_refusal(self._session.feed.live.offer_speed(speed, header_stamp(cdr)))

    def _report_refusal(self, sentence: str | None) -> None:
        if sentence is not None:
            self.get_logger().warning(sentence, throttle_duration_sec=1.0)

    # --- services ----------------------------------------------------------------------------------

    def _on_pause(self, request: Any, response: Any) -> Any:
        if self._session is None:
            response.success, response.message = False, "the twin is not configured"
        else:
            self._session.pause(request.data)
            response.success, response.message = True, "paused" if request.data else "running on"
        return response

    def _on_step(self, _request: Any, response: Any) -> Any:
        return self._answer(response, "step", "one block of 20 ms ordered")

    def _on_reset(self, _request: Any, response: Any) -> Any:
        response = self._answer(response, "reset", "the scene starts again at t = 0 with a new recording")
        if response.success:
            self._consumed_ns, self._clock_ns = None, 0
        return response

    def _answer(self, response: Any, order: str, done: str) -> Any:
        problem = "the twin is not configured"
        if self._session is not None:
            problem = getattr(self._session, order)() or ""
        response.success, response.message = not problem, problem or done
        return response

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
        sentence = f"{report.state}: {report.sentence}"
        if needs_attention(report) and sentence != self._announced:
            if self._session.exit_code:
                self.get_logger().error(sentence)
            else:
                self.get_logger().info(sentence)
        if sentence != self._announced:
            self._announced = sentence
            self._report()
        if report.state in END_STATES and not self.finished:
            self._finish(report.state)

    def _publish(self, outgoing: Outgoing) -> None:
        for name, cdr in outgoing.messages:
            if name == "truth":
                self._messages_of_run.clear()  # a new run begins
                self._all_published = False
            self._publish_of_run(name, cdr)
        if outgoing.clock_ns is None:
            return
        self._clock_ns, self._consumed_ns = outgoing.clock_ns, outgoing.consumed_ns
        if self._values.publish_clock:
            self._publish_of_run("/clock", encode_clock(outgoing.clock_ns))
        self._publish_of_run("load/consumed", encode_time(outgoing.consumed_ns))
        self._blocks_unconfirmed += 1
        tied_to_a_clock = 0.0 < self._speed_factor <= 1.0
        if self._blocks_unconfirmed >= BLOCKS_BEFORE_CONFIRMATION and not tied_to_a_clock:
            self._wait_for_readers()

    def _publish_of_run(self, name: str, cdr: bytes) -> None:
        self._messages_of_run[name] += 1
        self._out.publish(name, cdr)

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

    def _report(self) -> None:
        if self._consumed_ns is not None:
            self._publish_of_run("load/consumed", encode_time(self._consumed_ns))
        if self._session is None:
            return
        senders = self._intake.publisher_counts()
        known = senders.pop(self.resolve_topic_name("load/truth"), 0)
        if self._load_paused and not known:
            # whoever was paused knowingly is gone: from here on silence is a loss again
            self._load_paused = False
            self._session.feed.pause(False)
        report = self._session.report()
        status = twin_diagnostic(
            diagnostic_name(self.get_namespace(), "twin"),
            report,
            self._session.feed.refusals.report(),
            self._out.lost_messages,
            self._values.mode,
            self._speed_factor,
            sum(senders.values()),
        )
        if report.state in END_STATES and self._all_published:
            status = replace(status, values=status.values + published_values(self._messages_of_run))
        self._out.publish("/diagnostics", encode_diagnostics(self._clock_ns, FRAME, [status]))

    def _finish(self, state: str) -> None:
        """Finish the run: publish everything, then the last report, then rest or end."""
        assert self._session is not None
        for outgoing in self._session.collect():
            self._publish(outgoing)
        self._all_published = True
        self._flush()
        self._report()
        self._out.wait_until_received("/diagnostics", LAST_WORDS_TIMEOUT_S)
        if self._values.exit_when_done:
            self.exit_code = self._session.exit_code
            self.trigger_deactivate()
            self.finished = True
        elif state == FINISHED:
            self.get_logger().info("finished; the service reset starts the scene again")

    def _flush(self) -> None:
        deadline = time.monotonic() + LAST_WORDS_TIMEOUT_S
        for name in self._out.names:
            self._out.wait_until_received(name, max(deadline - time.monotonic(), 0.0))


def main(argv: Sequence[str], load_rig: RigLoader | None = None) -> int:
    """Run the node until the run is over."""
    return run_node(lambda: TwinNode(load_rig), argv)
