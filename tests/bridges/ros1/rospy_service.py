"""Service of Debian's rospy, run by Debian's Python: ``/switch`` of type std_srvs/SetBool, which refuses false."""

import rospy
from std_srvs.srv import SetBool, SetBoolResponse

rospy.init_node("lamp", disable_rosout=True)
rospy.Service("/switch", SetBool, lambda request: SetBoolResponse(request.data, "on" if request.data else "stays on"))
print("ready", flush=True)
rospy.spin()
