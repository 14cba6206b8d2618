"""Node of Debian's rospy, run by Debian's Python: drives a robot a metre, calls a service; prints what it has seen."""

import json

import rospy
import rosservice
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo
from std_msgs.msg import String
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage

rospy.init_node("driver", disable_signals=True, disable_rosout=True)
seen = {"x": 0.0, "stamps": 0, "links": [], "description": "", "width": 0, "K": []}


def moved(message):
    seen["x"] = message.pose.pose.position.x
    seen["stamps"] += message.header.stamp.to_sec() > 0.0


def placed(message):
    seen["links"] = [each.child_frame_id for each in message.transforms]


def described(message):
    seen["description"] = message.data[-8:]


def photographed(message):
    seen["width"], seen["K"] = message.width, message.K


rospy.Subscriber("/simpleton/odom", Odometry, moved)
rospy.Subscriber("/tf_static", TFMessage, placed)
rospy.Subscriber("/robot_description", String, described)
rospy.Subscriber("/simpleton/camera1/camera_info", CameraInfo, photographed)
drive = rospy.Publisher("/simpleton/cmd_vel", Twist, queue_size=1)
forward = Twist()
forward.linear.x = 1.0
while not (seen["x"] > 1.0 and seen["links"] and seen["width"]):
    drive.publish(forward)
    rospy.rostime.wallsleep(0.02)
seen["driven"] = seen["x"]
seen["services"] = rosservice.get_service_list()
seen["type"] = rosservice.get_service_type("/gazebo/spawn_sdf_model")
rospy.ServiceProxy("/gazebo/reset_simulation", Empty)()
while seen["x"] > 0.5:
    rospy.rostime.wallsleep(0.02)
seen["parameter"] = rospy.get_param("/robot_description")[-8:]
print(json.dumps(seen))
rospy.signal_shutdown("done")
