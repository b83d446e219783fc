"""Nodes with a cylindrical pair: twin, load, recorder and monitor of a wagon with a spalled outer ring."""

from __future__ import annotations

import pytest

from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file, write_mapping
from beardyn_core.record.messages import decode_diagnostics
from beardyn_core.record.reading import read_run
from beardyn_core.study.monitored_recording import Finding
from test.ros.graph import Graph

LONG_S = 300.0


@pytest.mark.slow
@pytest.mark.usefixtures("compiled_kernels")
def test_nodes_run_record_and_diagnose_a_cylindrical_pair(graph: Graph) -> None:
    path, output = graph.folder / "wagon.yaml", graph.folder / "run.mcap"
    keys = {**read_file(find("scenes", "freight_cylindrical_cup")), "tier": "lumped", "effects": "standard"}
    keys["sensors"] = [{**keys["sensors"][0], "position_mm": [0, 0, 170]}]  # on a rigid box
    keys["defects"] = [{**keys["defects"][0], "width_mm": 8, "length_mm": 40}]
    path.write_text(write_mapping(keys), encoding="utf-8")
    graph.listen("monitor/result")
    graph.node_process("twin", scene=str(path), speed_factor=0.0)
    graph.node_process("recorder", output=str(output), start_timeout=LONG_S)
    graph.node_process("monitor", bearing="WJ130x240", interval=0.5)
    graph.until(
        lambda: all(
            any(each.value("connected") == "true" for each in graph.statuses(part))
            for part in ("recorder", "monitor")
        ),
        "the connection of recorder and monitor",
        timeout=LONG_S,
    )
    graph.node_process("load", scene=str(path), duration=3.0)
    nodes = ("load", "twin", "monitor", "recorder")
    graph.until(
        lambda: all(graph.processes.exit_code(node) is not None for node in nodes),
        "the end of the nodes",
        timeout=LONG_S,
        check_processes=False,
    )
    assert {node: graph.processes.exit_code(node) for node in nodes} == dict.fromkeys(nodes, 0)
    found = Finding.from_diagnostic(decode_diagnostics(graph.messages["monitor/result"][-1])[1][0])
    assert found is not None
    assert found.verdict == "cup"
    run = read_run(output)
    assert run.complete
    assert run.description is not None
    assert run.description.shape.is_cylindrical
    assert run.description.shape.cup_ribs == "both"
    assert run.vibration is not None
    assert len(run.vibration.sample) > 3 * 25_600 - 32  # less the delay of the filters
