"""Drive a robot with a laser scanner through the house and avoid obstacles."""

from typing import Any

import numpy as np

from urdfkit.messages import TWIST, twist
from urdfkit.sim import Simulator

SCAN, COMMAND = "/scan", "/cmd_vel"
NEAR = 0.8  # [m]: distance ahead below which the robot turns away


def on_scan(scan: Any) -> None:
    """Publish a velocity command for one scan."""
    angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
    ranges = np.minimum(scan.ranges, scan.range_max)  # +inf: no obstacle in range
    left, right = ranges[(angles > 0) & (angles < 1)].min(), ranges[(angles > -1) & (angles < 0)].min()
    blocked = min(left, right) < NEAR
    speed, turn = (0.0, 1.0 if left > right else -1.0) if blocked else (0.3, 0.0)
    simulator.publish(COMMAND, TWIST, twist((speed, 0.0, 0.0), (0.0, 0.0, turn)))


simulator = Simulator("diff_wheeled_robot_with_laser", world="house")
simulator.subscribe(SCAN, "sensor_msgs/msg/LaserScan", on_scan)
simulator.run(20.0)
print("at x {:.1f} m, y {:.1f} m".format(*simulator.state.base_pose))
