from __future__ import annotations

from typing import Any

import pytest

from beardyn_core.physics.lanes.lanes import Lanes


@pytest.fixture(params=[8, 1], ids=["lanes8", "lanes1"])
def lanes(request: pytest.FixtureRequest) -> Any:
    """Vectors of eight and plain scalars."""
    return Lanes(request.param)
