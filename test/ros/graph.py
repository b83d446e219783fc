"""A ROS graph for one test: processes in a domain of their own, and a listener in the test itself."""

from __future__ import annotations

import time
from collections import defaultdict, deque
from collections.abc import Callable, Iterable
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from beardyn_ros.environment import PROFILE_VARIABLES, prepare_environment, this_machine_only
from beardyn_ros.processes import Processes, free_domain_id, local_environment, release_domain_id

if TYPE_CHECKING:
    from test.ros.nursery import Nursery

NAMESPACE = "/axlebox"
PATIENCE_S = 60.0
USUAL_LEASE, SHORT_LEASE = (f"<leaseDuration><sec>{seconds}</sec>" for seconds in (10, 4))
_left: deque[int] = deque(maxlen=20)


class Graph:
    """Real processes of one test, and what they publish.

    Nothing here sleeps for a guessed time: `until` spins until a condition holds, and fails with the
    processes' own words after a minute.

    Parameters
    ----------
    folder : Path
        The processes' own words go there.
    nursery : Nursery, optional
        Begins the nodes that it can begin; without one each is a new Python.
    """

    def __init__(self, folder: Path, nursery: Nursery | None = None) -> None:
        prepare_environment()
        self.folder = folder
        self._nursery = nursery
        self.domain = free_domain_id(_left)
        self.processes = Processes(local_environment(self.domain), folder)
        self.messages: dict[str, list[bytes]] = defaultdict(list)

    def __enter__(self) -> Graph:
        import os

        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node

        from beardyn_ros.wire import RawIntake, TopicPublishers

        os.environ.update(this_machine_only())
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=self.domain)
        self.node = Node("listener", namespace="axlebox", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self.out = TopicPublishers(self.node)
        self._intake = RawIntake(self.node)
        self.listen("/diagnostics")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        from beardyn_ros.runtime import leave_quietly

        # this node first: others that are killed do not leave quietly
        self._executor.shutdown()
        leave_quietly(self.node)
        self._context.try_shutdown()
        self.processes.end()
        release_domain_id(self.domain)
        _left.append(self.domain)

    # --- processes ---------------------------------------------------------------------------------

    def fake_twin(self, name: str = "twin", /, **parameters: object) -> None:
        """Twin node around the fake twin."""
        self.start(name, "test.ros.fake_twin", "twin", **{"scene": "fake", **parameters})

    def fake_load(self, name: str = "load", /, **parameters: object) -> None:
        """Load node with the fake history."""
        self.start(name, "test.ros.fake_twin", "load", **parameters)

    def node_process(self, node: str, /, **parameters: object) -> None:
        """Node of the package."""
        self.start(node, "beardyn_ros", node, **parameters)

    def shorten_lease(self) -> None:
        """Let processes started from now on count as dead after 4 s of silence instead of 10."""
        environment = self.processes._environment
        profile = Path(environment[PROFILE_VARIABLES[0]]).read_text()
        assert USUAL_LEASE in profile
        short = self.folder / "short_lease.xml"
        short.write_text(profile.replace(USUAL_LEASE, SHORT_LEASE))
        environment[PROFILE_VARIABLES[0]] = str(short)

    def start(self, name: str, module: str, *words: str, **parameters: object) -> None:
        """``python -m module words --ros-args -p ...``."""
        arguments = ["-m", module, *words]
        if parameters:
            arguments.append("--ros-args")
        for key, value in parameters.items():
            arguments += ["-p", f"{key}:={_yaml(value)}"]
        environment = self.processes._environment
        if self._nursery is None or not self._nursery.can_start(module, environment):
            self.processes.start(name, *arguments)
            return
        log = self.processes.log_path(name)
        self.processes._children[name] = self._nursery.start(module, tuple(arguments[2:]), environment, log)  # type: ignore[assignment]

    def exit_code(self, name: str) -> int:
        """Exit code of a process, waiting for its end while the graph goes on."""
        self.until(
            lambda: self.processes.exit_code(name) is not None, f"the end of {name}", check_processes=False
        )
        code = self.processes.exit_code(name)
        assert code is not None
        return code

    def dismiss(self, name: str) -> None:
        """Forget a process that has ended with an error, as it should."""
        assert self.exit_code(name) != 0
        del self.processes._children[name]

    # --- messages ----------------------------------------------------------------------------------

    def listen(self, *names: str) -> None:
        """Keep every message of these topics of the table."""
        from beardyn_core.record.topics import topic

        for name in names:
            self._intake.add(topic(name), self.messages[name].append)

    def drain(self) -> int:
        """Take everything that waits in the queues; how many messages that were."""
        return self._intake.sweep()

    def until(
        self,
        condition: Callable[[], Any],
        what: str,
        timeout: float = PATIENCE_S,
        check_processes: bool = True,
    ) -> Any:
        """Spin until the condition is true; its value."""
        deadline = time.monotonic() + timeout
        while not (value := condition()):
            self._executor.spin_once(timeout_sec=0.05)
            failed = self.processes.failed() if check_processes else []
            assert not failed, f"while waiting for {what}: {self._logs(failed)}"
            assert time.monotonic() < deadline, f"{what} has not come in {timeout:g} s. {self._logs()}"
        return value

    def statuses(self, part: str, namespace: str = NAMESPACE) -> list[Any]:
        """Diagnostics of a part so far, oldest first."""
        from beardyn_core.record.messages import decode_diagnostics

        name = f"{namespace.strip('/')}/{part}"
        found: list[Any] = []
        for cdr in self.messages["/diagnostics"]:
            found += [status for status in decode_diagnostics(cdr)[1] if status.name == name]
        return found

    def until_state(self, state: str, check_processes: bool = True) -> Any:
        """Diagnostics of the twin in a state."""

        def latest() -> Any:
            found = self.statuses("twin")
            return found[-1] if found and found[-1].value("state") == state else None

        return self.until(latest, f"twin state '{state}'", check_processes=check_processes)

    def connected(self, *names: str) -> None:
        """Wait until somebody listens to these topics of ours."""
        self.until(
            lambda: all(self.out.publisher(name).get_subscription_count() > 0 for name in names),
            f"a subscription to {', '.join(names)}",
        )

    def call(self, service: str, kind: Any, **request: Any) -> Any:
        """Response of a service in the namespace."""
        client: Any = self.node.create_client(kind, f"{NAMESPACE}/{service}")
        self.until(client.service_is_ready, f"service {service}")
        future = client.call_async(kind.Request(**request))
        self.until(future.done, f"response of {service}")
        self.node.destroy_client(client)
        return future.result()

    def parameters_of(self, node: str, name: str) -> Any:
        """Descriptor of a parameter of a node."""
        from rcl_interfaces.srv import DescribeParameters

        return self.call(f"{node}/describe_parameters", DescribeParameters, names=[name]).descriptors[0]

    def set_parameter(self, node: str, name: str, value: bool | float) -> Any:
        """Result of setting a parameter of a running node."""
        from rcl_interfaces.srv import SetParameters
        from rclpy.parameter import Parameter

        wanted = Parameter(name, value=value).to_parameter_msg()
        return self.call(f"{node}/set_parameters", SetParameters, parameters=[wanted]).results[0]

    def _logs(self, names: Iterable[str] | None = None) -> str:
        files = sorted(self.folder.glob("*.log"))
        chosen = [path for path in files if names is None or path.stem in set(names)]
        return "\n".join(f"--- {path.stem}\n{path.read_text(errors='replace')[-3000:]}" for path in chosen)


def _yaml(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
