"""Client of real rclpy, run by the Python of its own environment: goals for two controllers; prints their ends.

real_action_client.py ACTION JOINT GRIPPER: control_msgs is on Python's path.
"""

import json
import sys
import time

import rclpy
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory, GripperCommand
from rclpy.action import ActionClient, get_action_names_and_types
from trajectory_msgs.msg import JointTrajectoryPoint

action, joint, gripper = sys.argv[1:]
rclpy.init()
node = rclpy.create_node("mover")
client = ActionClient(node, FollowJointTrajectory, action)
assert client.wait_for_server(60.0), "no server"
seen = {"actions": get_action_names_and_types(node), "feedback": 0, "states": []}
seen["topics"] = sorted(name for name, _ in node.get_topic_names_and_types() if action in name)
seen["publishers"] = len(node.get_publishers_info_by_topic(f"{action}/_action/status"))


def followed(message):
    seen["feedback"] += 1
    seen["joints"] = list(message.feedback.joint_names)
    seen["positions"] = len(message.feedback.actual.positions)


def done(future):
    rclpy.spin_until_future_complete(node, future, timeout_sec=60.0)
    return future.result()


def send(joint, position, seconds):
    goal = FollowJointTrajectory.Goal()
    goal.trajectory.joint_names = [joint]
    goal.trajectory.points = [JointTrajectoryPoint(positions=[position], time_from_start=Duration(sec=seconds))]
    goal.multi_dof_trajectory.joint_names = ["base"]  # urdfkit lacks this field
    return done(client.send_goal_async(goal, feedback_callback=followed))


def ended(handle):
    response = done(handle.get_result_async())
    return [response.status, response.result.error_code]


def moved(handle):
    before, end = seen["feedback"], time.monotonic() + 60.0
    while seen["feedback"] == before and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.1)
    seen["states"].append(handle.status)


reached = send(joint, 0.2, 1)
moved(reached)
seen["reached"] = ended(reached)
seen["rejected"] = not send("nobody", 0.2, 1).accepted
cancelled = send(joint, 1.0, 60)
moved(cancelled)
seen["cancelling"] = len(done(cancelled.cancel_goal_async()).goals_canceling)
seen["cancelled"] = ended(cancelled)
replaced = send(joint, 1.0, 60)
moved(replaced)
seen["last"] = ended(send(joint, 0.1, 1))
seen["replaced"] = ended(replaced)
grip = GripperCommand.Goal()
grip.command.position, grip.command.max_effort = 0.3, 50.0
hand = ActionClient(node, GripperCommand, gripper)
assert hand.wait_for_server(60.0), "no server of the gripper"
response = done(done(hand.send_goal_async(grip)).get_result_async())
seen["gripped"] = [response.status, response.result.reached_goal, response.result.position]
print(json.dumps(seen))
