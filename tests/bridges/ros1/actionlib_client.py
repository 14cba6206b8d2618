"""Client of Debian's actionlib, run by Debian's Python: goals to a trajectory controller; prints how they ended.

The messages, which Debian lacks, are made by genpy from the definitions of control_msgs in Noetic.
"""

import json
import sys

import actionlib
import rospy
from genpy.dynamic import generate_dynamic

POINT = "trajectory_msgs/JointTrajectoryPoint"
DEFINITIONS = {
    "FollowJointTrajectoryAction": "".join(
        f"FollowJointTrajectoryAction{part} action_{part.lower()}\n" for part in ("Goal", "Result", "Feedback")
    ),
    "FollowJointTrajectoryActionGoal": "Header header\nactionlib_msgs/GoalID goal_id\nFollowJointTrajectoryGoal goal",
    "FollowJointTrajectoryActionResult": "Header header\nactionlib_msgs/GoalStatus status\n"
    "FollowJointTrajectoryResult result",
    "FollowJointTrajectoryActionFeedback": "Header header\nactionlib_msgs/GoalStatus status\n"
    "FollowJointTrajectoryFeedback feedback",
    "FollowJointTrajectoryGoal": "trajectory_msgs/JointTrajectory trajectory\nJointTolerance[] path_tolerance\n"
    "JointTolerance[] goal_tolerance\nduration goal_time_tolerance",
    "FollowJointTrajectoryResult": "int32 error_code\nint32 SUCCESSFUL = 0\nint32 INVALID_GOAL = -1\n"
    "int32 INVALID_JOINTS = -2\nint32 OLD_HEADER_TIMESTAMP = -3\nint32 PATH_TOLERANCE_VIOLATED = -4\n"
    "int32 GOAL_TOLERANCE_VIOLATED = -5\n\nstring error_string",
    "FollowJointTrajectoryFeedback": f"Header header\nstring[] joint_names\n{POINT} desired\n{POINT} actual\n"
    f"{POINT} error",
    "JointTolerance": "string name\nfloat64 position\nfloat64 velocity\nfloat64 acceleration",
    "actionlib_msgs/GoalID": "time stamp\nstring id",
    "actionlib_msgs/GoalStatus": "GoalID goal_id\nuint8 status\n"
    + "".join(
        f"uint8 {name} = {code}\n"
        for code, name in enumerate(
            [
                "PENDING",
                "ACTIVE",
                "PREEMPTED",
                "SUCCEEDED",
                "ABORTED",
                "REJECTED",
                "PREEMPTING",
                "RECALLING",
                "RECALLED",
                "LOST",
            ]
        )
    )
    + "string text",
    "std_msgs/Header": "uint32 seq\ntime stamp\nstring frame_id",
    "trajectory_msgs/JointTrajectory": "Header header\nstring[] joint_names\nJointTrajectoryPoint[] points",
    "trajectory_msgs/JointTrajectoryPoint": "float64[] positions\nfloat64[] velocities\nfloat64[] accelerations\n"
    "float64[] effort\nduration time_from_start",
}

parts = [(name if "/" in name else f"control_msgs/{name}", text.strip() + "\n") for name, text in DEFINITIONS.items()]
text = parts[0][1] + "".join(f"{'=' * 80}\nMSG: {name}\n{each}" for name, each in parts[1:])
types = generate_dynamic("control_msgs/FollowJointTrajectoryAction", text)

rospy.init_node("mover", disable_signals=True, disable_rosout=True)
client = actionlib.SimpleActionClient(sys.argv[1], types["control_msgs/FollowJointTrajectoryAction"])
assert client.wait_for_server(rospy.Duration(60)), "no server"
seen = {"feedback": 0}


def followed(feedback):
    seen["feedback"] += 1
    seen["joints"] = feedback.joint_names


def goal(joint, position, seconds, tolerance=0.0):
    made = types["control_msgs/FollowJointTrajectoryGoal"]()
    made.trajectory.joint_names = [joint]
    point = types[POINT]()
    point.positions, point.time_from_start = [position], rospy.Duration(seconds)
    made.trajectory.points = [point]
    if tolerance:
        limit = types["control_msgs/JointTolerance"]()
        limit.name, limit.position = joint, tolerance
        made.path_tolerance = [limit]
    return made


def ended(wanted, cancel=False):
    """Send a goal; return its state, the code of its result and the text, when it has ended.

    The handle is asked: `wait_for_result` waits for ever if the answer arrives before `send_goal` has returned.
    """
    before = seen["feedback"]
    client.send_goal(wanted, feedback_cb=followed)
    while cancel and seen["feedback"] == before:
        rospy.rostime.wallsleep(0.02)
    if cancel:
        client.cancel_goal()
    while client.gh.get_comm_state() != actionlib.CommState.DONE:
        rospy.rostime.wallsleep(0.02)
    return [client.gh.get_terminal_state(), client.gh.get_result().error_code, client.gh.get_goal_status_text()]


seen["reached"] = ended(goal("jarmLink0", 0.3, 0.5))
seen["unknown"] = ended(goal("jarmLink9", 0.3, 0.5))
seen["cancelled"] = ended(goal("jarmLink0", 1.0, 60.0), cancel=True)
seen["off"] = ended(goal("jarmLink0", 1.0, 0.1, tolerance=1e-6))
print(json.dumps(seen))
rospy.signal_shutdown("done")
