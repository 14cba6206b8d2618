"""Node of a real rclpy, run by the Python of its own environment: prints what it sees and receives as JSON.

Arguments: seconds to run, the topic to drive on, its odometry; both empty for a node that only listens; a topic that
ends the node when it is listed.
"""

import json
import sys
import time

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

seconds, command, odometry = float(sys.argv[1]), sys.argv[2], sys.argv[3]
awaited = sys.argv[4]
rclpy.init()
node = rclpy.create_node("listener")
seen = {"descriptions": 0, "odometry": 0, "x": None}


def described(message):
    seen["descriptions"] += message.data.count("</robot>")


def moved(message):
    seen["odometry"] += 1
    seen["x"] = message.pose.pose.position.x


latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_subscription(String, "/robot_description", described, latched)
if odometry:
    node.create_subscription(Odometry, odometry, moved, 10)
    publisher = node.create_publisher(Twist, command, 10)
    forward = Twist()
    forward.linear.x = 0.5
    node.create_timer(0.05, lambda: publisher.publish(forward))
end = time.monotonic() + seconds
while time.monotonic() < end and not (odometry and seen["x"] is not None and seen["x"] > 1.0):
    rclpy.spin_once(node, timeout_sec=0.1)
    if awaited and awaited in dict(node.get_topic_names_and_types()):
        break
types = dict(node.get_topic_names_and_types())
publishers = {}
for name in types:
    for each in node.get_publishers_info_by_topic(name):
        if each.node_name != "listener":
            quality = each.qos_profile
            publishers[name] = [quality.reliability.name, quality.durability.name]
print(json.dumps({**seen, "types": types, "publishers": publishers}))
