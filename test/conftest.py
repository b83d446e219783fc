"""Shared by all tests: no user configuration leaks in, nothing is written outside temporary folders."""

from __future__ import annotations

from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]


@pytest.fixture(autouse=True)
def _shipped_configuration(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BEARDYN_CONFIG", raising=False)


@pytest.fixture
def repository() -> Path:
    """Root of the checkout."""
    return REPOSITORY
