"""Recordings on the page: a bag and a robot go in; the robot moves on the page as it was recorded, with all topics.

Poses come from the recorded transforms where there are any, else from the joint states and the odometry.
"""
