"""A program of roslibpy: sends goals to a trajectory controller and prints how they ended as JSON.

Arguments: port of the server, name of the action, a joint.
"""

import json
import sys
from queue import Queue

import roslibpy

port, name, joint = int(sys.argv[1]), sys.argv[2], sys.argv[3]
ros = roslibpy.Ros("127.0.0.1", port)
ros.run(timeout=60)
client = roslibpy.ActionClient(ros, name, "control_msgs/action/FollowJointTrajectory")
feedback, ends = Queue(), Queue()


def ended(end):
    ends.put([end["status"].value, end["values"]])


def send(joint, position, seconds):
    point = {"positions": [position], "time_from_start": {"sec": int(seconds), "nanosec": int(seconds % 1 * 1e9)}}
    goal = roslibpy.Goal({"trajectory": {"joint_names": [joint], "points": [point]}})
    return client.send_goal(goal, ended, feedback.put, ended)


seen = {}
send(joint, 0.3, 0.5)
seen["reached"] = ends.get(timeout=60)
seen["joints"] = feedback.get(timeout=60)["joint_names"]
send("jarmLink9", 0.3, 0.5)
seen["rejected"] = ends.get(timeout=60)
while not feedback.empty():
    feedback.get()
number = send(joint, 1.0, 60.0)
feedback.get(timeout=60)
client.cancel_goal(number)
seen["cancelled"] = ends.get(timeout=60)
print(json.dumps(seen))
ros.terminate()
