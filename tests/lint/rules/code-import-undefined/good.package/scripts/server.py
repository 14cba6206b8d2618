#!/usr/bin/env python3
import rospy
from pruner.srv import PruneCane, PruneCaneResponse
from pruner.msg import RowState
from std_srvs.srv import Trigger

rospy.init_node("server")
