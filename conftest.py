"""Shared by all tests: no user configuration leaks in, nothing is written outside temporary folders."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

REPOSITORY = Path(__file__).resolve().parent
NODES = "test/ros"


def pytest_configure(config: pytest.Config) -> None:
    """Select the examples of hypothesis: the same every time in the fast suite, new ones in the long one."""
    settings.register_profile("repeatable", derandomize=True)
    if config.getoption("markexpr") == "not slow":
        settings.load_profile("repeatable")


def process_group(nodeid: str) -> str:
    """Name what must run in one process: the tests of a file, for they share runs, and all nodes together."""
    file = nodeid.partition("::")[0]
    return NODES if file.startswith(f"{NODES}/") else file


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the nodes, the longest group of all, so that no process waits for them at the end."""
    items.sort(key=lambda item: process_group(item.nodeid) != NODES)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Hand whole groups to the processes, in the order of collection.

    The marker `xdist_group` would do as well, but pytest 9.2 and pytest-xdist 3.8 ignore it together.
    """
    from xdist.scheduler import LoadScopeScheduling

    class ByGroup(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return process_group(nodeid)

        def remove_node(self, node: Any) -> str | None:
            """Take back the work of a process that has died, without the test that it died in.

            pytest-xdist 3.8 would give that test to the next process, and the one after it, for ever.
            """
            work = self.assigned_work.pop(node)
            waiting = [(group, test) for group in work for test, done in work[group].items() if not done]
            if not waiting:
                return None
            group, died_in = waiting[0]
            work[group][died_in] = True
            self.workqueue.update({name: tests for name, tests in work.items() if not all(tests.values())})
            for other in self.assigned_work:
                self._reschedule(other)
            return died_in

        def _reschedule(self, node: Any) -> None:
            """Give a process two tests, or tell it that there are no more: else it does not begin one."""
            super()._reschedule(node)
            while not node.shutting_down and self._pending_of(self.assigned_work[node]) < 2:
                super()._reschedule(node)

    config.option.loadscopereorder = False
    return ByGroup(config, log)


@pytest.fixture(autouse=True)
def _shipped_configuration(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BEARDYN_CONFIG", raising=False)


@pytest.fixture
def repository() -> Path:
    """Root of the checkout."""
    return REPOSITORY


@pytest.fixture(scope="session")
def kept_equilibria() -> Iterator[None]:
    """For tests that choose tiers, effects or steps: each static equilibrium is solved once in a session."""
    from test.choice.equilibria import equilibria_kept

    with equilibria_kept():
        yield
