"""A node of ROS 1 without rospy: the XML-RPC of the master and of nodes, and messages by TCPROS.

https://wiki.ros.org/ROS/Technical%20Overview
"""
