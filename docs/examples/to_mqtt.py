# to_mqtt.py [BROKER[:PORT]]: verdict and numbers of one axlebox to an MQTT broker, each message as JSON
import json
import sys

import paho.mqtt.client as mqtt
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Vector3Stamped, WrenchStamped
from sensor_msgs.msg import Temperature

TOPICS = {"monitor/result": DiagnosticArray, "force": WrenchStamped, "temperature": Temperature}
TOPICS |= {f"values/{name}": Vector3Stamped for name in ("verdict", "confidence", "rms")}


def plain(value):
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, (list, bytes)):  # the level of a status is a byte
        return [plain(each) for each in value] if isinstance(value, list) else value[0]
    return None if value != value else value  # JSON has no NaN


host, _, port = (sys.argv[1] if len(sys.argv) > 1 else "localhost").partition(":")
client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2)
client.connect(host, int(port or 1883))
client.loop_start()
rclpy.init()
node = rclpy.create_node("to_mqtt", namespace="axlebox")
for name, kind in TOPICS.items():
    settings = {"topic": f"axlebox/{name}", "retain": name in ("monitor/result", "values/verdict")}
    node.create_subscription(
        kind, name, lambda message, to=settings: client.publish(payload=json.dumps(plain(message)), **to), 200
    )
rclpy.spin(node)
