"""The subscriber of the README, copied out of it and run against a live twin."""

from __future__ import annotations

import re
from pathlib import Path

from test.ros.graph import Graph

README = Path(__file__).parents[2] / "README.md"


def subscriber_example() -> str:
    """The fenced python block of the README whose info string or first line says ``subscriber``."""
    blocks = re.findall(r"^```python([^\n]*)\n(.*?)^```", README.read_text(), re.M | re.S)
    chosen = [
        code for info, code in blocks if "subscriber" in info or "subscriber" in code.partition("\n")[0]
    ]
    assert len(chosen) == 1, "README.md needs exactly one python block marked `subscriber`"
    return chosen[0]


def test_subscriber_of_the_readme_prints_blocks_of_a_live_twin(graph: Graph) -> None:
    code = subscriber_example()
    assert len(code.strip().splitlines()) <= 25
    script = graph.folder / "subscriber.py"
    script.write_text(code)
    graph.processes.start("subscriber", str(script))
    graph.fake_twin(speed_factor=1.0)
    graph.until(
        lambda: graph.node.count_subscribers("/axlebox/vibration") > 0, "the subscriber of the README"
    )
    graph.fake_load(duration=60.0)
    graph.until(
        lambda: len([line for line in graph.processes.log("subscriber").splitlines() if line.strip()]) >= 5,
        "five lines of the subscriber",
    )
    assert "Traceback" not in graph.processes.log("subscriber")
