"""Service of real rclpy, run by the Python of its own environment: ``/switch`` of type std_srvs/SetBool."""

import rclpy
from std_srvs.srv import SetBool


def switch(request, response):
    response.success, response.message = request.data, "on" if request.data else "stays on"
    return response


rclpy.init()
node = rclpy.create_node("lamp")
node.create_service(SetBool, "/switch", switch)
print("ready", flush=True)
rclpy.spin(node)
