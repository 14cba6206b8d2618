"""A ROS 1 node without rospy.

It uses XML-RPC with the master and with other nodes, and TCPROS for messages and services:
https://wiki.ros.org/ROS/Technical%20Overview.
"""
