"""Frames and the services of a simulator over DDS, with the interface packages built for the test."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from beardyn_core.record.messages import decode
from beardyn_core.record.topics import JOINTS
from test.ros.graph import Graph

pytestmark = pytest.mark.ros


@pytest.mark.parametrize("built_interfaces", ["tf2_msgs"], indirect=True)
def test_frames_of_a_box_form_one_tree_and_its_cone_turns(built_interfaces: None, graph: Graph) -> None:
    from tf2_msgs.msg import TFMessage

    from beardyn_ros.robot_description import LATCHED

    moving: list[Any] = []
    graph.node.create_subscription(TFMessage, "/tf", moving.append, 1000)
    graph.listen("joint_states")
    graph.fake_twin(
        joint_tf=True, parent_frame="car", pose_in_parent="1.0 2.0 0.46 0 0 0", exit_when_done=False
    )
    graph.fake_load(duration=1.0)
    graph.until_state("finished")
    fixed: list[Any] = []
    graph.node.create_subscription(TFMessage, "/tf_static", fixed.append, LATCHED)
    graph.until(lambda: fixed and len(moving) == 50, "the frames, for a reader that comes late")
    tree = {each.child_frame_id: each for each in (*fixed[0].transforms, *moving[-1].transforms)}
    assert {each.header.frame_id for each in tree.values()} == {"car", "axlebox"}
    assert tree["axlebox"].header.frame_id == "car"
    assert tree["axlebox"].transform.translation.y == 2.0
    parts = {"cup", "cone", "axlebox_top", "rollers", "cages", "grease", "cage_0", "roller_1_3"}
    assert {f"axlebox/{part}" for part in parts} <= set(tree)
    states = {
        (message.header.stamp.sec, message.header.stamp.nanosec): dict(
            zip(message.name, message.position, strict=True)
        )
        for message in (decode(JOINTS, cdr) for cdr in graph.messages["joint_states"])
    }
    for message in moving:
        for each in message.transforms:
            angles = states[(each.header.stamp.sec, each.header.stamp.nanosec)]
            joint = {"cone": "shaft"}.get(name := each.child_frame_id.removeprefix("axlebox/"), name)
            half = 0.5 * angles[joint]
            turn = each.transform.rotation
            assert (turn.y, turn.w) == pytest.approx((np.sin(half), np.cos(half)), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("built_interfaces", ["simulation_interfaces"], indirect=True)
def test_a_client_of_any_simulator_pauses_steps_and_quits(built_interfaces: None, graph: Graph) -> None:
    from simulation_interfaces.msg import Result, SimulationState, SimulatorFeatures
    from simulation_interfaces.srv import (
        GetSimulationState,
        GetSimulatorFeatures,
        ResetSimulation,
        SetSimulationState,
        StepSimulation,
    )

    def state() -> int:
        return int(graph.call("get_simulation_state", GetSimulationState).state.state)

    def set_state(wanted: int) -> int:
        answer = graph.call("set_simulation_state", SetSimulationState, state=SimulationState(state=wanted))
        return int(answer.result.result)

    def blocks() -> int:
        return int(graph.statuses("twin")[-1].value("blocks"))

    graph.fake_twin(speed_factor=1.0)
    graph.fake_load(duration=300.0, exit_when_done=False)
    graph.until_state("running")
    features = graph.call("get_simulator_features", GetSimulatorFeatures).features.features
    assert SimulatorFeatures.STEP_SIMULATION_MULTIPLE in features
    assert state() == SimulationState.STATE_PLAYING
    assert graph.call("step_simulation", StepSimulation).result.result == Result.RESULT_OPERATION_FAILED
    assert set_state(SimulationState.STATE_PAUSED) == Result.RESULT_OK
    before = int(graph.until_state("paused").value("blocks"))
    assert graph.call("step_simulation", StepSimulation, steps=3).result.result == Result.RESULT_OK
    graph.until(lambda: blocks() == before + 3, "what the answer has said")
    assert set_state(SimulationState.STATE_PAUSED) == SetSimulationState.Response.ALREADY_IN_TARGET_STATE
    alone = graph.call("reset_simulation", ResetSimulation, scope=ResetSimulation.Request.SCOPE_TIME)
    assert alone.result.result == Result.RESULT_FEATURE_UNSUPPORTED
    assert set_state(SimulationState.STATE_STOPPED) == Result.RESULT_OK
    assert state() == SimulationState.STATE_STOPPED
    assert set_state(SimulationState.STATE_PLAYING) == Result.RESULT_OK
    graph.until(lambda: 0 < blocks() < before + 50 and state() == SimulationState.STATE_PLAYING, "a new run")
    assert set_state(SimulationState.STATE_QUITTING) == Result.RESULT_OK
    assert graph.exit_code("twin") == 0
