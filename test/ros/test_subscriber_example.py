"""The subscriber of docs/in_ros.md, copied out of it and run against a live twin."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from test.ros.graph import Graph

PAGE = Path(__file__).parents[2] / "docs" / "in_ros.md"


def subscriber_example() -> str:
    """The fenced python block of docs/in_ros.md whose info string or first line says ``subscriber``."""
    blocks = re.findall(r"^```python([^\n]*)\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    chosen = [
        code for info, code in blocks if "subscriber" in info or "subscriber" in code.partition("\n")[0]
    ]
    assert len(chosen) == 1, "docs/in_ros.md needs exactly one python block marked `subscriber`"
    return chosen[0]


@pytest.mark.usefixtures("compiled_kernels")
def test_subscriber_of_the_page_prints_blocks_of_a_live_twin(graph: Graph) -> None:
    code = subscriber_example()
    assert len(code.strip().splitlines()) <= 25
    script = graph.folder / "subscriber.py"

    def printed() -> list[str]:
        return [line for line in graph.processes.log("subscriber").splitlines() if line.strip()]

    script.write_text(code)
    graph.processes.start("subscriber", str(script))
    graph.node_process("twin", scene="cup_spall")
    graph.until(lambda: graph.node.count_subscribers("/axlebox/vibration") > 0, "the subscriber of the page")
    graph.node_process("load", scene="cup_spall")
    graph.until(lambda: len(printed()) >= 5, "five lines of the subscriber")
    assert "Traceback" not in graph.processes.log("subscriber")
    form = re.compile(r"sample \d+: \d+ samples, az \d+\.\d\d m/s\^2 rms")
    assert all(form.fullmatch(line) for line in printed()[:5])
