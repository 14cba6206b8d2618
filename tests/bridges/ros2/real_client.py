"""Client of real rclpy, run by the Python of its own environment: calls a service of the simulation."""

import rclpy
from std_srvs.srv import Empty

rclpy.init()
node = rclpy.create_node("client")
client = node.create_client(Empty, "/gazebo/reset_simulation")
assert client.wait_for_service(60.0), "no service"
answer = client.call_async(Empty.Request())
rclpy.spin_until_future_complete(node, answer, timeout_sec=60.0)
print("answered" if answer.done() else "no answer")
