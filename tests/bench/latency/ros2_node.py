"""Node of a real rclpy that measures, run by the Python of its own environment; prints the result as JSON.

Arguments: number of commands, 1 to receive images too, topics of the command, the odometry and the images.
"""

import json
import sys
from collections import deque
from pathlib import Path

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

sys.path.insert(0, str(Path(__file__).parent))
from measurement import measured


class Driver:
    """A node that drives."""

    def __init__(self, images, command, odometry, image):
        self._node = rclpy.create_node("driver")
        self._received = deque()
        self._publisher = self._node.create_publisher(Twist, command, 10)
        self._node.create_subscription(Odometry, odometry, self._moved, 10)
        if images:
            self._node.create_subscription(Image, image, self._seen, qos_profile_sensor_data)

    def _moved(self, message):
        self._received.append(("odometry", message.twist.twist.linear.x))

    def _seen(self, message):
        self._received.append(("image", 0.0))

    def command(self, x):
        """Publish a forward velocity [m/s]."""
        twist = Twist()
        twist.linear.x = x
        self._publisher.publish(twist)

    def receive(self):
        """Return what was received next."""
        while not self._received:
            rclpy.spin_once(self._node, timeout_sec=0.1)
        return self._received.popleft()


rclpy.init()
print(json.dumps(measured(Driver(sys.argv[2] == "1", *sys.argv[3:6]), int(sys.argv[1]))))
