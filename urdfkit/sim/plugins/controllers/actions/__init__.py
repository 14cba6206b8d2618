"""Action servers of controllers: goals, feedback and results over topics, for ROS 1 and ROS 2.

A goal message goes in; its status, feedback and result are published.
"""
