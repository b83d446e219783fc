from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def _every_test_chooses(kept_equilibria: None) -> None:
    """Let all choices of this folder share their equilibria."""
