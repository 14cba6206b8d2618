"""Action of real rclpy, run by the Python of its own environment: ``/arm/follow_joint_trajectory`` moves ``elbow``.

control_msgs is on Python's path.
"""

import time

import rclpy
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor


def take(goal):
    return GoalResponse.ACCEPT if goal.trajectory.joint_names == ["elbow"] else GoalResponse.REJECT


def move(handle):
    (point,) = handle.request.trajectory.points
    end = time.monotonic() + point.time_from_start.sec
    result = FollowJointTrajectory.Result()
    while time.monotonic() < end:
        feedback = FollowJointTrajectory.Feedback()
        feedback.joint_names, feedback.desired.positions = ["elbow"], point.positions
        handle.publish_feedback(feedback)
        if handle.is_cancel_requested:
            handle.canceled()
            print("canceled", flush=True)
            return result
        time.sleep(0.05)
    if point.positions[0] > 1:
        result.error_code, result.error_string = result.PATH_TOLERANCE_VIOLATED, "elbow is off by 0.5 rad"
        handle.abort()
    else:
        handle.succeed()
    return result


rclpy.init()
node = rclpy.create_node("arm")
group = ReentrantCallbackGroup()
server = ActionServer(
    node,
    FollowJointTrajectory,
    "/arm/follow_joint_trajectory",
    move,
    callback_group=group,
    goal_callback=take,
    cancel_callback=lambda handle: CancelResponse.ACCEPT,
)
print("ready", flush=True)
rclpy.spin(node, MultiThreadedExecutor())
