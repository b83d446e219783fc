"""Bridges to other worlds: MQTT and Foxglove, each with the messages of real nodes at the far end."""

from __future__ import annotations

import importlib.util
import json
import shutil
import socket
import struct
import subprocess
import sys
import threading
import time
from collections import defaultdict
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from beardyn_core.record.encoding import temperature_template
from beardyn_core.record.messages import DIAGNOSTICS, decode
from beardyn_core.record.topics import TOPICS, WRENCH, topic
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected

ROOT = Path(__file__).resolve().parents[2]
BRIDGES = ROOT / "bridges"
EXAMPLES = ROOT / "docs" / "examples"
NUMERIC = "geometry_msgs/msg/Vector3Stamped"
SPACE = "/axlebox/"
MOSQUITTO = shutil.which("mosquitto") or shutil.which("mosquitto", path="/usr/sbin:/usr/local/sbin")
AMQTT = """import asyncio, sys
from amqtt.broker import Broker
async def serve():
    plugins = {"amqtt.plugins.authentication.AnonymousAuthPlugin": {"allow_anonymous": True}}
    listeners = {"default": {"type": "tcp", "bind": "127.0.0.1:" + sys.argv[1]}}
    broker = Broker({"listeners": listeners, "plugins": plugins})
    await broker.start()
    await asyncio.Event().wait()
asyncio.run(serve())
"""


def has(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


def free_port() -> int:
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        return int(held.getsockname()[1])


def answers(port: int) -> bool:
    with socket.socket() as tried:
        return tried.connect_ex(("127.0.0.1", port)) == 0


# --- configuration of existing bridges ---------------------------------------------------------------


def type_on(name: str) -> str:
    """Type of an absolute topic; ``values/<quantity>`` are numbers."""
    assert name.startswith(SPACE), name
    relative = name.removeprefix(SPACE)
    try:
        return topic(relative).type
    except KeyError:
        assert relative.startswith("values/"), f"{name} is not in the topic table"
        return NUMERIC


def test_mqtt_client_is_given_topics_of_the_table_with_their_types() -> None:
    whole = yaml.safe_load((BRIDGES / "mqtt_client.yaml").read_text(encoding="utf-8"))
    bridge = whole["/**/*"]["ros__parameters"]["bridge"]["ros2mqtt"]
    assert sorted(bridge["ros_topics"]) == sorted(set(bridge) - {"ros_topics"})
    for name in bridge["ros_topics"]:
        entry = bridge[name]
        assert entry["ros_type"] == type_on(name)
        assert entry["json"] is True  # without it a payload is CDR, which only another mqtt_client reads
        assert entry["mqtt_topic"] == name.removeprefix("/")
    assert bridge["/axlebox/monitor/result"]["advanced"]["mqtt"]["retained"] is True


def test_mqtt_bridge_is_given_the_same_topics() -> None:
    whole = yaml.safe_load((BRIDGES / "mqtt_bridge.yaml").read_text(encoding="utf-8"))
    given = whole["mqtt_bridge_node"]["ros__parameters"]
    bridges = [given["bridge"][f"bridge{number + 1}"] for number in range(given["n_bridges"])]
    assert len(bridges) == len(given["bridge"])
    for factory, kind, source, target in bridges:
        assert factory == "mqtt_bridge.bridge:RosToMqttBridge"
        package, _, name = kind.partition(".msg:")
        assert f"{package}/msg/{name}" == type_on(source)
        assert target.replace("~", f"/{given['mqtt']['private_path']}", 1) == source
    client = yaml.safe_load((BRIDGES / "mqtt_client.yaml").read_text(encoding="utf-8"))
    listed = client["/**/*"]["ros__parameters"]["bridge"]["ros2mqtt"]["ros_topics"]
    assert [source for _, _, source, _ in bridges] == listed


# --- MQTT ----------------------------------------------------------------------------------------------


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[int]:
    """Port of an MQTT broker on this machine."""
    if not has("paho"):
        pytest.skip("paho-mqtt is not installed (pip install paho-mqtt)")
    port = free_port()
    if MOSQUITTO:
        command = [MOSQUITTO, "-p", str(port)]
    elif has("amqtt"):
        command = [sys.executable, "-c", AMQTT, str(port)]
    else:
        pytest.skip("there is no MQTT broker (apt install mosquitto, or pip install amqtt)")
    with (tmp_path / "broker.txt").open("wb") as log:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
    try:
        deadline = time.monotonic() + 60.0
        while not answers(port):
            assert process.poll() is None, (tmp_path / "broker.txt").read_text()
            assert time.monotonic() < deadline, "the broker does not answer"
            time.sleep(0.05)
        yield port
    finally:
        process.terminate()
        process.wait(20.0)


class Subscriber:
    """A client of the broker that keeps what it receives, by topic."""

    def __init__(self, port: int) -> None:
        mqtt: Any = import_module("paho.mqtt.client")
        self.received: dict[str, list[dict[str, Any]]] = defaultdict(list)
        self.is_subscribed = threading.Event()
        self._client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
        self._client.on_message = self._keep
        self._client.on_subscribe = lambda *_: self.is_subscribed.set()
        self._client.connect("127.0.0.1", port)
        self._client.subscribe("axlebox/#", qos=1)
        self._client.loop_start()

    def _keep(self, _client: Any, _data: Any, message: Any) -> None:
        self.received[message.topic].append(json.loads(message.payload))

    def end(self) -> None:
        self._client.disconnect()
        self._client.loop_stop()


def test_verdict_and_numbers_reach_a_subscriber_of_mqtt(graph: Graph, broker: int) -> None:
    script = EXAMPLES / "to_mqtt.py"
    assert len(script.read_text(encoding="utf-8").splitlines()) <= 36
    subscriber = Subscriber(broker)
    graph.until(subscriber.is_subscribed.is_set, "the subscription at the broker")
    graph.listen("force", "monitor/result")
    graph.processes.start("to_mqtt", str(script), f"127.0.0.1:{broker}")
    graph.fake_twin(speed_factor=1.0)
    graph.node_process("monitor", bearing="HS130x230", interval=0.5)
    is_connected(graph, "monitor")
    two = ("/axlebox/force", "/axlebox/monitor/result", "/axlebox/temperature")  # the script and one more
    graph.until(
        lambda: all(graph.node.count_subscribers(name) >= 2 for name in two),
        "the subscriptions of the script",
    )
    graph.until(
        lambda: graph.out.publisher("temperature").get_subscription_count() >= 2, "both for temperature"
    )
    graph.fake_load(duration=3.0)
    (row,) = temperature_template("axlebox/cup").encode(np.zeros(1, np.int64), celsius=np.full((1, 1), 61.5))
    graph.out.publish("temperature", row)
    assert graph.exit_code("monitor") == 0
    received = subscriber.received

    def final() -> dict[str, str]:
        told = received["axlebox/monitor/result"]
        return {} if not told else {each["key"]: each["value"] for each in told[-1]["status"][0]["values"]}

    graph.until(lambda: final().get("final") == "true", "the last verdict at the broker")
    graph.until(lambda: len(received["axlebox/force"]) >= len(graph.messages["force"]), "every force")
    subscriber.end()

    assert final()["verdict"] == "cup"
    last = decode(DIAGNOSTICS, graph.messages["monitor/result"][-1]).status[0]
    told = received["axlebox/monitor/result"][-1]["status"][0]
    assert (told["name"], told["message"], told["level"]) == (last.name, last.message, last.level)
    assert final() == {each.key: each.value for each in last.values}
    assert [each["temperature"] for each in received["axlebox/temperature"]] == [61.5]
    for cdr, sent in zip(graph.messages["force"], received["axlebox/force"], strict=True):
        true = decode(WRENCH, cdr)
        assert sent["wrench"]["force"]["z"] == true.wrench.force.z
        assert sent["header"]["stamp"] == {"sec": true.header.stamp.sec, "nanosec": true.header.stamp.nanosec}


# --- Foxglove ------------------------------------------------------------------------------------------


class FoxgloveClient:
    """A client of a Foxglove WebSocket server that knows nothing but what the server advertises."""

    def __init__(self, port: int) -> None:
        connect: Any = import_module("websockets.sync.client").connect
        self.advertised: dict[str, dict[str, Any]] = {}
        self.received: dict[str, list[bytes]] = defaultdict(list)
        self._names: dict[int, str] = {}
        self._socket = connect(
            f"ws://127.0.0.1:{port}", subprotocols=["foxglove.sdk.v1"], max_size=None, compression=None
        )
        self.subprotocol = self._socket.subprotocol

    def take(self) -> None:
        """Take what waits."""
        while True:
            try:
                frame = self._socket.recv(timeout=0.01)
            except TimeoutError:
                return
            if isinstance(frame, bytes):
                code, number, _log_time = struct.unpack_from("<BIQ", frame)
                assert code == 1, "message data"
                self.received[self._names[number]].append(frame[13:])
            elif (told := json.loads(frame))["op"] == "advertise":
                self.advertised |= {each["topic"]: each for each in told["channels"]}

    def subscribe(self, *topics: str) -> None:
        wanted = []
        for name in topics:
            number = len(self._names) + 1
            self._names[number] = name
            wanted.append({"id": number, "channelId": self.advertised[name]["id"]})
        self._socket.send(json.dumps({"op": "subscribe", "subscriptions": wanted}))

    def end(self) -> None:
        self._socket.close()


@pytest.mark.skipif(
    not (has("foxglove") and has("websockets")),
    reason="the Foxglove SDK is not installed (pip install foxglove-sdk websockets)",
)
def test_a_foxglove_client_reads_topics_by_the_advertised_schemas_alone(graph: Graph) -> None:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    script = EXAMPLES / "to_foxglove.py"
    assert len(script.read_text(encoding="utf-8").splitlines()) <= 30
    port = free_port()
    graph.processes.start("to_foxglove", str(script), str(port))
    graph.until(lambda: answers(port), "the Foxglove server")
    client = FoxgloveClient(port)
    assert client.subprotocol == "foxglove.sdk.v1"

    def taken(condition: Any) -> Any:
        client.take()
        return condition()

    graph.until(lambda: taken(lambda: len(client.advertised) == len(TOPICS)), "the advertised topics")
    for entry in TOPICS:
        channel = client.advertised[entry.path()]
        assert channel["schemaName"] == entry.type
        assert (channel["encoding"], channel["schemaEncoding"]) == ("cdr", "ros2msg")
    shown = ("force", "vibration", "imu", "truth", "/diagnostics")
    client.subscribe(*(topic(name).path() for name in shown))
    graph.listen("force", "vibration")
    graph.until(lambda: graph.node.count_subscribers("/axlebox/force") >= 2, "subscriptions of the script")
    graph.fake_twin(speed_factor=1.0)
    graph.until(lambda: graph.statuses("twin"), "the twin")
    of_ros = {
        name: graph.node.get_publishers_info_by_topic(topic(name).path())[0].topic_type_hash for name in shown
    }
    graph.fake_load(duration=1.0)
    graph.until(lambda: taken(lambda: graph.processes.exit_code("twin") is not None), "the end of the twin")
    wanted = {"/axlebox/force": 400, "/axlebox/vibration": 50}
    graph.until(
        lambda: taken(lambda: all(len(client.received[name]) >= count for name, count in wanted.items())),
        "every force and vibration",
    )
    client.end()
    for name in shown:
        path, kind = topic(name).path(), topic(name).type
        assert client.received[path], f"nothing of {name}"
        store = get_typestore(Stores.EMPTY)
        store.register(get_types_from_msg(client.advertised[path]["schema"], kind))
        assert store.hash_rihs01(kind) == str(of_ros[name]), "ROS has another definition"
        for cdr in client.received[path]:
            store.deserialize_cdr(cdr, kind)
    assert client.received["/axlebox/vibration"] == graph.messages["vibration"]
    assert client.received["/axlebox/force"] == graph.messages["force"]
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(client.advertised["/axlebox/force"]["schema"], WRENCH))
    read: Any = store.deserialize_cdr(client.received["/axlebox/force"][-1], WRENCH)
    assert read.wrench.force.z == decode(WRENCH, graph.messages["force"][-1]).wrench.force.z
