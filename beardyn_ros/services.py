"""Services that answer when the work is done, while their node goes on.

``step`` is one of std_srvs; where the package simulation_interfaces is installed, the twin offers the
standard services of a simulator as well, in its namespace: ``get_simulator_features``,
``get_simulation_state``, ``set_simulation_state``, ``step_simulation`` and ``reset_simulation``.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from typing import TYPE_CHECKING, Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.task import Future
from std_srvs.srv import Trigger

from beardyn_ros.run_state import COMPILING, END_STATES, IDLE, PAUSED

if TYPE_CHECKING:
    from beardyn_ros.session import TwinSession

PACKAGE = "simulation_interfaces"
# what a twin can do; a name that an older version of the package does not have is left out
FEATURES = (
    "SIMULATION_RESET",
    "SIMULATION_STATE_GETTING",
    "SIMULATION_STATE_SETTING",
    "SIMULATION_STATE_PAUSE",
    "STEP_SIMULATION_SINGLE",
    "STEP_SIMULATION_MULTIPLE",
)
MOST_STEPS = 100_000  # half an hour of simulated time
INFO = "one step is a block of 20 ms; a reset takes time and state back together; see docs/nodes.md"
PATIENCE_S = 10.0


class StepService:
    """Service ``step`` of one more piece of work, answered when the piece is done.

    Parameters
    ----------
    node : rclpy.node.Node
    name : str
    order : callable
        Orders a piece; a sentence when that is not possible, '' otherwise.
    done : str
        What the answer says then.
    """

    def __init__(self, node: Any, name: str, order: Callable[[], str], done: str) -> None:
        self._order = order
        self._done = done
        self._waiting: deque[tuple[float, Future[str]]] = deque()
        # a group of its own: an answer that waits must not hold up the other callbacks of the node
        node.create_service(Trigger, name, self._on_request, callback_group=ReentrantCallbackGroup())

    async def _on_request(self, _request: Any, response: Any) -> Any:
        problem = self._order()
        if not problem:
            answer: Future[str] = Future()
            self._waiting.append((time.monotonic() + PATIENCE_S, answer))
            problem = await answer or ""
        response.success, response.message = not problem, problem or self._done
        return response

    def complete(self) -> None:
        """Answer the oldest order: it is done."""
        if self._waiting:
            self._waiting.popleft()[1].set_result("")

    def fail(self, problem: str) -> None:
        """Answer every order: it will not be done."""
        while self._waiting:
            self._waiting.popleft()[1].set_result(problem)

    def fail_late(self, problem: str) -> None:
        """Answer the orders that have waited for longer than `PATIENCE_S` seconds."""
        while self._waiting and self._waiting[0][0] < time.monotonic():
            self._waiting.popleft()[1].set_result(problem)


@dataclass
class StepOrder:
    """Blocks that a request waits for.

    Parameters
    ----------
    session : TwinSession
    steps : int
    until : int or None
        Number of blocks at which it is done; ``None`` until the run holds, for a block may be under way.
    done : Future
    """

    session: TwinSession
    steps: int
    until: int | None = None
    done: Future = field(default_factory=Future)


def interfaces() -> tuple[Any, Any]:
    """Import messages and services of simulation_interfaces; ``None`` for both where it is not installed."""
    try:
        return import_module(f"{PACKAGE}.msg"), import_module(f"{PACKAGE}.srv")
    except ImportError:
        return None, None


class SimulationServices:
    """Offers the twin's run by the standard services.

    Parameters
    ----------
    node : rclpy.node.Node
    session : callable
        Gives the present `TwinSession`, ``None`` while the twin is not configured.
    reset : callable
        Starts the scene again; a sentence when that is not possible.
    quit : callable
        Ends the process in order.
    modules : tuple of module
        ``simulation_interfaces.msg`` and ``.srv``; nothing is offered where they are ``None``.
    """

    def __init__(
        self,
        node: Any,
        session: Callable[[], TwinSession | None],
        reset: Callable[[], str],
        quit: Callable[[], None],
        modules: tuple[Any, Any],
    ) -> None:
        self._session, self._reset, self._quit = session, reset, quit
        self._messages, services = modules
        self._stopped = False
        self._orders: list[StepOrder] = []
        if services is None:
            return
        # a step that waits for its answer must not hold up the other callbacks
        group = ReentrantCallbackGroup()
        self._set_kind = services.SetSimulationState
        for name, callback in (
            ("GetSimulatorFeatures", self.on_features),
            ("GetSimulationState", self.on_get_state),
            ("SetSimulationState", self.on_set_state),
            ("StepSimulation", self.on_step),
            ("ResetSimulation", self.on_reset),
        ):
            kind = getattr(services, name)
            node.create_service(kind, _snake(name), callback, callback_group=group)

    def look(self) -> None:
        """Begin and answer steps; to be called whenever the session has something new."""
        still = []
        for order in self._orders:
            session, report = order.session, order.session.report()
            if order.until is not None and report.blocks >= order.until and session is self._session():
                order.done.set_result(True)
                continue
            if session is not self._session() or report.state in END_STATES or not session.paused:
                order.done.set_result(False)
                continue
            if order.until is None and report.state == PAUSED:
                order.until = report.blocks + order.steps
                for _ in range(order.steps):
                    session.step()
            still.append(order)
        self._orders = still

    # --- callbacks ---------------------------------------------------------------------------------

    def on_features(self, _request: Any, response: Any) -> Any:
        """List what a twin can do."""
        known = self._messages.SimulatorFeatures
        response.features.features = [getattr(known, name) for name in FEATURES if hasattr(known, name)]
        response.features.custom_info = INFO
        return response

    def on_get_state(self, _request: Any, response: Any) -> Any:
        """Tell the state."""
        response.state.state = self.state()
        response.result.result = self._messages.Result.RESULT_OK
        return response

    def on_set_state(self, request: Any, response: Any) -> Any:
        """Play, pause, stop (which is pause and reset) or quit."""
        states, wanted = self._messages.SimulationState, request.state.state
        result, session = response.result, self._session()
        if wanted == states.STATE_QUITTING:
            result.result = self._messages.Result.RESULT_OK
            self._quit()
            return response
        if wanted not in (states.STATE_PLAYING, states.STATE_PAUSED, states.STATE_STOPPED):
            return self._refuse(response, "RESULT_FEATURE_UNSUPPORTED", f"there is no way to state {wanted}")
        if session is None:
            return self._refuse(response, "RESULT_INCORRECT_STATE", "the twin is not configured")
        if wanted == self.state():
            result.result = self._set_kind.Response.ALREADY_IN_TARGET_STATE
            return response
        problem = ""
        if wanted == states.STATE_STOPPED:
            session.pause(True)
            problem = self._reset()
        elif session.report().state in END_STATES:
            problem = "the run has ended: reset it first"
        else:
            session.pause(wanted == states.STATE_PAUSED)
        if problem:
            result.result = self._set_kind.Response.STATE_TRANSITION_ERROR
            result.error_message = problem
            return response
        self._stopped = wanted == states.STATE_STOPPED
        result.result = self._messages.Result.RESULT_OK
        return response

    async def on_step(self, request: Any, response: Any) -> Any:
        """Advance some blocks while paused; answers when they are done."""
        session, steps = self._session(), int(request.steps)
        if session is None:
            return self._refuse(response, "RESULT_INCORRECT_STATE", "the twin is not configured")
        if not 1 <= steps <= MOST_STEPS:
            return self._refuse(
                response, "RESULT_OPERATION_FAILED", f"steps is {steps}; allowed is 1 to {MOST_STEPS}"
            )
        if not session.paused or session.report().state in END_STATES:
            return self._refuse(response, "RESULT_OPERATION_FAILED", "the twin is not paused: pause it first")
        self._stopped = False
        order = StepOrder(session, steps)
        self._orders.append(order)
        self.look()
        if await order.done:
            response.result.result = self._messages.Result.RESULT_OK
            return response
        return self._refuse(
            response,
            "RESULT_OPERATION_FAILED",
            "the run went on, was reset or ended before the steps were done",
        )

    def on_reset(self, request: Any, response: Any) -> Any:
        """Start the scene again; time and state can only go together."""
        scopes = type(request)
        both = scopes.SCOPE_TIME | scopes.SCOPE_STATE
        if request.scope != scopes.SCOPE_DEFAULT and request.scope & both != both:
            return self._refuse(
                response,
                "RESULT_FEATURE_UNSUPPORTED",
                f"scope {request.scope}: time and state are reset together (0, {both} or 255)",
            )
        problem = self._reset()
        if problem:
            return self._refuse(response, "RESULT_INCORRECT_STATE", problem)
        response.result.result = self._messages.Result.RESULT_OK
        return response

    def state(self) -> int:
        """Find the state in the words of the package."""
        states, session = self._messages.SimulationState, self._session()
        found = IDLE if session is None else session.report().state
        if found == COMPILING:
            return int(getattr(states, "STATE_LOADING_WORLD", states.STATE_STOPPED))
        if session is None or found == IDLE or found in END_STATES:
            return int(states.STATE_STOPPED)
        if not session.paused:
            return int(states.STATE_PLAYING)
        return int(states.STATE_STOPPED if self._stopped else states.STATE_PAUSED)

    def _refuse(self, response: Any, code: str, sentence: str) -> Any:
        response.result.result = getattr(self._messages.Result, code)
        response.result.error_message = sentence
        return response


def _snake(name: str) -> str:
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name).strip("_")
