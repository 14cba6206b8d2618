#!/usr/bin/env python3
import rospy
from pruner.msg import PruneCane, PruneCaneResponse  # <!-- expect: K994 -->
from pruner.msg import RowStat  # <!-- expect: K994 -->
from std_srvs.msg import Trigger  # <!-- expect: K994 -->

rospy.init_node("server")
