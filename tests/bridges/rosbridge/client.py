"""A program of roslibpy: drives a robot and prints what it saw as JSON. Run with the port of the server."""

import json
import sys
import time

import roslibpy

ros = roslibpy.Ros("127.0.0.1", int(sys.argv[1]))
ros.run(timeout=60)
poses, images = [], []
roslibpy.Topic(ros, "/simpleton/odom", "nav_msgs/Odometry").subscribe(lambda it: poses.append(it["pose"]["pose"]))
roslibpy.Topic(ros, "/simpleton/camera1/image_raw", "sensor_msgs/Image").subscribe(images.append)
driving = roslibpy.Topic(ros, "/simpleton/cmd_vel", "geometry_msgs/Twist")
end = time.monotonic() + 120
while time.monotonic() < end and not (poses and poses[-1]["position"]["x"] > 1.0 and images):
    driving.publish(roslibpy.Message({"linear": {"x": 0.5}}))
    time.sleep(0.05)
x, image = poses[-1]["position"]["x"], images[-1]
reset = roslibpy.Service(ros, "/gazebo/reset_simulation", "std_srvs/Empty").call(
    roslibpy.ServiceRequest({}), timeout=60
)
remove = roslibpy.Service(ros, "/gazebo/delete_model", "gazebo_msgs/DeleteModel")
request = roslibpy.ServiceRequest({"model_name": "nobody"})
print(
    json.dumps(
        {
            "topics": ros.get_topics(),
            "types": {name: ros.get_topic_type(name) for name in ros.get_topics()},
            "x": x,
            "image": [image[name] for name in ("encoding", "width", "height")],
            "reset": dict(reset),
            "delete": dict(remove.call(request, timeout=60)),
            "description": ros.get_param("/robot_description"),
        }
    )
)
ros.terminate()
