"""What a twin says of its run, without a graph."""

from __future__ import annotations

import pytest

from beardyn_ros.load_gate import RefusalReport
from beardyn_ros.run_state import SessionReport
from beardyn_ros.twin_report import NodeStanding, twin_diagnostic

STANDING = NodeStanding("", 0, "lockstep", 0.0, 1, {}, 0, ())
NONE_REFUSED = RefusalReport(0, (), "", recent=False)


@pytest.mark.parametrize("residual", [None, 0.0, 2e-5])
def test_without_an_audit_no_residual_is_told(residual: float | None) -> None:
    """An `energy_residual` of zero would be a balance that holds, and nobody has kept one."""
    report = SessionReport(blocks=3, simulated_s=0.06, energy_residual=residual)
    told = twin_diagnostic("axlebox/twin", report, NONE_REFUSED, STANDING).value("energy_residual")
    assert told == (None if residual is None else f"{residual:.3e}")
