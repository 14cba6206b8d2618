"""Node of a real rclpy that counts distinct images, best effort as the viewers of ROS are: prints their number.

Argument: the number of images that are sent.
"""

import sys
import time

import rclpy
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

sent, seen = int(sys.argv[1]), set()
rclpy.init()
node = rclpy.create_node("viewer")
node.create_subscription(Image, "/image", lambda message: seen.add(message.header.stamp.sec), qos_profile_sensor_data)
print("ready", flush=True)
end = time.monotonic() + 60.0
while time.monotonic() < end and sent not in seen:
    rclpy.spin_once(node, timeout_sec=0.1)
print(len(seen), flush=True)
