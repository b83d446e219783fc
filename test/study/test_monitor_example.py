"""The example of a monitor of one's own: it runs, finds a fault, and is what the tutorial shows."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from beardyn_core.monitor.chain import Chain, Stretch
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS, fault_signal

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "my_monitor.py"


@pytest.mark.parametrize("fault", ["cup", "cone", "roller"])
def test_the_example_finds_faults(fault: str) -> None:
    chain = runpy.run_path(str(EXAMPLE))["chain"]
    assert isinstance(chain, Chain)
    _, angle, acceleration = fault_signal(fault, 50)
    result = chain(Stretch(RATE, acceleration, angle, 8e4, 0), ORDERS, ROLLERS, SETTINGS)
    assert result.verdict == fault, result.reason
    assert result.band[1] - result.band[0] == pytest.approx(2000.0)


def test_the_tutorial_shows_the_example_as_it_runs() -> None:
    page = (ROOT / "docs" / "tutorial" / "own_monitor.md").read_text(encoding="utf-8")
    assert f"```python\n{EXAMPLE.read_text(encoding='utf-8')}```" in page
    assert len(EXAMPLE.read_text(encoding="utf-8").splitlines()) <= 20
