"""The services of simulation_interfaces, which is in no package registry: stand-in messages, a real run."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip("rclpy", reason="rclpy is not installed (pip install .[ros])")

from beardyn_ros.run_state import SessionOptions
from beardyn_ros.services import FEATURES, SimulationServices
from beardyn_ros.session import TwinSession
from test.ros.fake_twin import fake_history, fake_rig

PATIENCE_S = 20.0


class Features:
    SIMULATION_RESET, SIMULATION_STATE_GETTING, SIMULATION_STATE_SETTING = 20, 24, 25
    SIMULATION_STATE_PAUSE, STEP_SIMULATION_SINGLE, STEP_SIMULATION_MULTIPLE = 26, 31, 32


class State:
    """Numbers of simulation_interfaces 2.1."""

    STATE_STOPPED, STATE_PLAYING, STATE_PAUSED, STATE_QUITTING, STATE_NO_WORLD, STATE_LOADING_WORLD = range(6)


class Result:
    RESULT_FEATURE_UNSUPPORTED, RESULT_OK, RESULT_NOT_FOUND = 0, 1, 2
    RESULT_INCORRECT_STATE, RESULT_OPERATION_FAILED = 3, 4


class Reset:
    SCOPE_DEFAULT, SCOPE_TIME, SCOPE_STATE, SCOPE_SPAWNED, SCOPE_ALL = 0, 1, 2, 4, 255

    def __init__(self, scope: int) -> None:
        self.scope = scope


class Set:
    class Response:
        ALREADY_IN_TARGET_STATE, STATE_TRANSITION_ERROR, INCORRECT_TRANSITION = 101, 102, 103


MESSAGES = SimpleNamespace(SimulatorFeatures=Features, SimulationState=State, Result=Result)
NAMES = ("GetSimulatorFeatures", "GetSimulationState", "StepSimulation", "ResetSimulation")
SERVICES = SimpleNamespace(SetSimulationState=Set, **{name: SimpleNamespace() for name in NAMES})


def response() -> Any:
    return SimpleNamespace(
        result=SimpleNamespace(result=None, error_message=""),
        state=SimpleNamespace(state=None),
        features=SimpleNamespace(features=[], custom_info=""),
    )


class Rig:
    """Services around a session that runs the fake twin on a second of load."""

    def __init__(self) -> None:
        options = SessionOptions(
            mode="lockstep",
            load_timeout=4.0,
            start_timeout=20.0,
            max_age=1.0,
            queue_ns=10**11,
            queue_bytes=10**9,
            join=False,
            live_bandwidth=10.0,
            frame="axlebox",
            instance="fake",
        )
        self.session: TwinSession | None = TwinSession(fake_rig("fake", ""), options, 0.0, lambda: None)
        self.offered: dict[str, Callable[..., Any]] = {}
        self.quits = 0
        node = SimpleNamespace(create_service=lambda kind, name, call, **_: self.offered.update({name: call}))
        self.services = SimulationServices(
            node, lambda: self.session, self._reset, self._quit, (MESSAGES, SERVICES)
        )

    def _reset(self) -> str:
        return "not configured" if self.session is None else self.session.reset() or ""

    def _quit(self) -> None:
        self.quits += 1

    def begin(self) -> TwinSession:
        assert self.session is not None
        self.session.compile()
        self.session.activate(True)
        return self.session

    def send(self, seconds: float = 1.0) -> None:
        assert self.session is not None
        load = fake_history("", "", seconds)
        for first in range(0, len(load) - 1, 200):
            part = load.part(first, first + 200)
            assert self.session.feed.gate.offer(part, range_of(first, len(part))) is None

    def until(self, condition: Callable[[], Any]) -> None:
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < deadline
            assert self.session is not None
            self.session.collect()
            self.services.look()
            time.sleep(0.002)

    def step(self, steps: int) -> Any:
        """Call the service, and the executor's part of it: its coroutine is sent on until it answers."""
        answers: list[Any] = []
        waiting = self.services.on_step(SimpleNamespace(steps=steps), response())

        def answered() -> bool:
            try:
                waiting.send(None)
            except StopIteration as end:
                answers.append(end.value)
            return bool(answers)

        self.until(answered)
        return answers[0].result

    def set_state(self, state: int) -> Any:
        request = SimpleNamespace(state=SimpleNamespace(state=state))
        return self.services.on_set_state(request, response()).result

    def reset(self, scope: int) -> Any:
        return self.services.on_reset(Reset(scope), response()).result


def range_of(first: int, count: int) -> Any:
    import numpy as np

    return np.arange(first, first + count)


@pytest.fixture
def rig() -> Iterator[Rig]:
    made = Rig()
    yield made
    if made.session is not None:
        made.session.end(5.0)


def test_five_services_are_offered_and_the_features_are_told(rig: Rig) -> None:
    assert set(rig.offered) == {
        "get_simulator_features",
        "get_simulation_state",
        "set_simulation_state",
        "step_simulation",
        "reset_simulation",
    }
    told = rig.services.on_features(None, response()).features.features
    assert told == [getattr(Features, name) for name in FEATURES] == [20, 24, 25, 26, 31, 32]


def test_a_step_answers_when_its_blocks_are_done_and_the_run_holds_again(rig: Rig) -> None:
    session = rig.begin()
    assert rig.step(1).result == Result.RESULT_OPERATION_FAILED  # not paused
    assert rig.set_state(State.STATE_PAUSED).result == Result.RESULT_OK
    rig.send()
    rig.until(lambda: session.report().state == "paused")
    for steps in (1, 5):
        before = session.report().blocks
        assert rig.step(steps).result == Result.RESULT_OK
        assert session.report().blocks == before + steps
    assert rig.services.state() == State.STATE_PAUSED
    assert rig.step(0).result == Result.RESULT_OPERATION_FAILED
    before = session.report().blocks
    assert (
        rig.step(60).result == Result.RESULT_OPERATION_FAILED
    )  # load for 50 blocks only, then nothing comes
    assert session.report().blocks > before


def test_a_step_of_all_blocks_that_are_left_succeeds(rig: Rig) -> None:
    session = rig.begin()
    rig.until(lambda: session.report().state != "compiling")
    assert rig.set_state(State.STATE_PAUSED).result == Result.RESULT_OK
    rig.send(0.2)
    session.feed.gate.offer(fake_history("", "", 1.0).part(0, 0), range_of(0, 0))
    rig.until(lambda: session.report().state == "paused")
    assert rig.step(9).result == Result.RESULT_OK
    assert session.report().blocks == 9


def test_states_follow_the_run(rig: Rig) -> None:
    session = rig.begin()
    rig.until(lambda: session.report().state != "compiling")
    assert rig.services.state() == State.STATE_PLAYING
    assert rig.set_state(State.STATE_PLAYING).result == Set.Response.ALREADY_IN_TARGET_STATE
    assert rig.set_state(State.STATE_PAUSED).result == Result.RESULT_OK
    assert rig.services.state() == State.STATE_PAUSED
    rig.send()
    rig.until(lambda: session.report().state == "paused")
    left = session.report().run_id
    assert rig.set_state(State.STATE_STOPPED).result == Result.RESULT_OK
    assert rig.services.state() == State.STATE_STOPPED
    rig.until(lambda: session.report().run_id not in ("", left))
    assert rig.set_state(State.STATE_PLAYING).result == Result.RESULT_OK
    rig.send()
    rig.until(lambda: session.report().blocks > 3)
    session.feed.gate.offer(fake_history("", "", 1.0).part(0, 0), range_of(0, 0))
    rig.until(lambda: session.report().state == "finished")
    assert rig.services.state() == State.STATE_STOPPED
    refused = rig.set_state(State.STATE_PLAYING)
    assert refused.result == Set.Response.STATE_TRANSITION_ERROR
    assert "reset it first" in refused.error_message
    assert rig.set_state(State.STATE_NO_WORLD).result == Result.RESULT_FEATURE_UNSUPPORTED
    assert rig.set_state(State.STATE_QUITTING).result == Result.RESULT_OK
    assert rig.quits == 1


def test_time_and_state_are_reset_together(rig: Rig) -> None:
    session = rig.begin()
    rig.send()
    rig.until(lambda: session.report().blocks > 3)
    for scope in (Reset.SCOPE_TIME, Reset.SCOPE_STATE, Reset.SCOPE_SPAWNED):
        assert rig.reset(scope).result == Result.RESULT_FEATURE_UNSUPPORTED
    first = session.report().run_id
    for scope in (Reset.SCOPE_DEFAULT, Reset.SCOPE_TIME | Reset.SCOPE_STATE, Reset.SCOPE_ALL):
        assert rig.reset(scope).result == Result.RESULT_OK
        rig.until(lambda: session.report().run_id not in ("", first))  # noqa: B023
        first = session.report().run_id


def test_a_twin_that_is_not_configured_says_so(rig: Rig) -> None:
    assert rig.services.state() == State.STATE_STOPPED
    rig.session = None
    assert rig.services.state() == State.STATE_STOPPED
    assert rig.set_state(State.STATE_PAUSED).result == Result.RESULT_INCORRECT_STATE
    assert rig.reset(0).result == Result.RESULT_INCORRECT_STATE
