"""The benchmarks that run whole twins: in parallel, and as nodes in real time."""

from __future__ import annotations

import pytest

from test.ros.conftest import ROS_IS_MISSING


@pytest.mark.slow
def test_parallel_twins_are_compared_with_one_of_the_same_turns() -> None:
    from benchmarks.parallel_twins import parallel

    table = parallel(2)
    assert [row[0] for row in table.rows] == ["one twin", "two threads", "two processes"]
    ratios = {str(row[0]): [float(cell) for cell in row[2:]] for row in table.rows}
    assert ratios["one twin"] == [1.0, 1.0, 1.0]
    assert all(least <= middle <= most for middle, least, most in ratios.values())
    assert all(0.0 < most < 3.0 for _, _, most in ratios.values())


@pytest.mark.slow
@pytest.mark.ros
@pytest.mark.skipif(ROS_IS_MISSING, reason="rclpy is not installed (pip install .[ros])")
def test_paced_twin_is_received_block_by_block_and_its_lateness_agrees_with_the_listener() -> None:
    from beardyn_core.choice import load_scene
    from benchmarks.paced_twin import COLUMNS, Level, row, run_paced

    level = Level("full", "standard")
    scene = load_scene("cup_spall", **level._asdict(), duration=1.0)
    received = run_paced(scene)
    told = dict(zip(COLUMNS, row(level, scene, received), strict=True))
    assert told["state"] == "finished"
    assert told["blocks"] == 50
    assert told["simulated s"] == pytest.approx(1.0)
    assert float(told["wall s"]) > 0.9
    # what the twin says about itself cannot be worse than what a reader sees, but for the time of its start
    assert float(told["worst late ms"]) < float(told["worst arrival ms"]) + 60.0
