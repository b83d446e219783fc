"""Shared by all tests: no user configuration leaks in, nothing is written outside temporary folders."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings

REPOSITORY = Path(__file__).resolve().parent


def pytest_configure(config: pytest.Config) -> None:
    """Select the examples of hypothesis: the same every time in the fast suite, new ones in the long one."""
    settings.register_profile("repeatable", derandomize=True)
    if config.getoption("markexpr") == "not slow":
        settings.load_profile("repeatable")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep the tests of a file in one process, for they share runs, and all nodes in one."""
    for item in items:
        group = "nodes" if "graph" in getattr(item, "fixturenames", ()) else item.nodeid.partition("::")[0]
        item.add_marker(pytest.mark.xdist_group(group))


@pytest.fixture(autouse=True)
def _shipped_configuration(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BEARDYN_CONFIG", raising=False)


@pytest.fixture
def repository() -> Path:
    """Root of the checkout."""
    return REPOSITORY
