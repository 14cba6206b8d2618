"""Run Debian's robot_state_publisher on joint states and print the transforms it publishes; for /usr/bin/python3.

Reads ``{"urdf": "…", "states": [{"joint": position, …}, …]}`` from standard input and writes, for every state, the
list of ``[parent, child, [x, y, z], [qx, qy, qz, qw]]`` that arrived on /tf and /tf_static. ROS_MASTER_URI names a free
port.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import threading

import rosgraph
import rospy
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

PUBLISHER = "/usr/lib/robot_state_publisher/robot_state_publisher"
STAMP_STEP = 0.05  # [s] robot_state_publisher drops states whose stamps are less than 20 ms apart
PATIENCE = 180.0  # [s] for anything to start or to end


class Listener:
    """Keeps the last transform of every child frame, and wakes whoever waits for a stamp."""

    def __init__(self):
        self.changed = threading.Condition()
        self.static = {}
        self.moving = {}
        self.stamp = None

    def hear_static(self, message):
        with self.changed:
            for transform in message.transforms:
                self.static[transform.child_frame_id] = _plain(transform)
            self.changed.notify_all()

    def hear_moving(self, message):
        with self.changed:
            for transform in message.transforms:
                self.moving[transform.child_frame_id] = _plain(transform)
                self.stamp = transform.header.stamp
            self.changed.notify_all()

    def wait_for(self, condition, timeout):
        with self.changed:
            return self.changed.wait_for(condition, timeout)


def _plain(stamped):
    t, r = stamped.transform.translation, stamped.transform.rotation
    return [stamped.header.frame_id, stamped.child_frame_id, [t.x, t.y, t.z], [r.x, r.y, r.z, r.w]]


@contextlib.contextmanager
def running(command):
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=sys.stderr)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def until(condition, what, *processes):
    """Wait for what has no event to wait for: a server that starts, a connection that is made."""
    for _ in range(int(PATIENCE / 0.02)):
        if condition():
            return
        for process in processes:
            if process.poll() is not None:
                sys.exit(f"{process.args[0]} ended with code {process.returncode}")
        threading.Event().wait(0.02)
    sys.exit(f"waited {PATIENCE:g} s for {what} in vain")


def main():
    request = json.load(sys.stdin)
    port = os.environ["ROS_MASTER_URI"].rsplit(":", 1)[1].strip("/")
    with running(["/usr/bin/rosmaster", "--core", "-p", port]) as master:
        until(rosgraph.is_master_online, "rosmaster", master)
        rospy.set_param("/robot_description", request["urdf"])
        rospy.init_node("truth", disable_signals=True, disable_rosout=True)
        listener = Listener()
        moving = rospy.Subscriber("/tf", TFMessage, listener.hear_moving, queue_size=100)
        rospy.Subscriber("/tf_static", TFMessage, listener.hear_static, queue_size=100)
        states = rospy.Publisher("/joint_states", JointState, queue_size=10)
        with running([PUBLISHER]) as publisher:
            until(
                lambda: states.get_num_connections() and moving.get_num_connections(),
                "robot_state_publisher",
                publisher,
            )
            json.dump([answer(listener, states, k, state) for k, state in enumerate(request["states"])], sys.stdout)
            rospy.signal_shutdown("done")


def answer(listener, publisher, number, positions):
    """Publish one state and return the transforms of that stamp."""
    message = JointState()
    message.header.stamp = rospy.Time.from_sec(1000.0 + number * STAMP_STEP)
    message.name, message.position = list(positions), list(positions.values())
    publisher.publish(message)
    if not listener.wait_for(lambda: listener.stamp == message.header.stamp and listener.static, PATIENCE):
        sys.exit(f"no answer to joint state {number}")
    with listener.changed:
        return list(listener.static.values()) + list(listener.moving.values())


if __name__ == "__main__":
    main()
