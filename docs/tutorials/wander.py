"""Wander: a robot with a laser drives about the house and turns away from what is near."""

from typing import Any

import numpy as np

from urdfkit.messages import TWIST, twist
from urdfkit.sim import Simulator

SCAN, COMMAND = "/scan", "/cmd_vel"
NEAR = 0.8  # [m]: what is nearer ahead is turned away from


def look(scan: Any) -> None:
    """Steer by one scan."""
    angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
    ranges = np.minimum(scan.ranges, scan.range_max)  # +inf where nothing is
    left, right = ranges[(angles > 0) & (angles < 1)].min(), ranges[(angles > -1) & (angles < 0)].min()
    blocked = min(left, right) < NEAR
    speed, turn = (0.0, 1.0 if left > right else -1.0) if blocked else (0.3, 0.0)
    simulator.bus.publish(COMMAND, TWIST, twist((speed, 0.0, 0.0), (0.0, 0.0, turn)))


simulator = Simulator("diff_wheeled_robot_with_laser", world="house")
simulator.subscribe(SCAN, "sensor_msgs/msg/LaserScan", look)
simulator.run(20.0)
print("at x {:.1f} m, y {:.1f} m".format(*simulator.state.base_pose))
