"""Which diagnostics of a recording make a torque budget."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from beardyn_core.record.encoding import loss_key
from beardyn_core.record.messages import Diagnostic
from beardyn_core.record.run_summary import recorded_budget

SECOND = 1_000_000_000


def recording(*values: tuple[tuple[str, str], ...]) -> Any:
    shaft = SimpleNamespace(time=np.arange(len(values)) * 1.0, speed=np.full(len(values), 100.0))
    told = tuple((k * SECOND, (Diagnostic("axlebox", 0, "", each),)) for k, each in enumerate(values))
    return cast(Any, SimpleNamespace(diagnostics=told, shaft=shaft))


def test_energies_lost_by_source_make_a_budget() -> None:
    budget = recorded_budget(recording(*(((loss_key("rib"), f"{50.0 * k}"),) for k in range(4))))
    assert budget is not None
    assert budget.to_json()["power_W"]["rib"] == pytest.approx(50.0)


def test_lost_samples_and_messages_of_the_nodes_are_no_energy() -> None:
    counts = (("lost_samples", "0"), ("lost_messages", "3"))
    assert recorded_budget(recording(counts, counts, counts)) is None
