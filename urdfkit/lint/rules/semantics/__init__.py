"""Rules for the geometry of the robot: drive wheels, casters, optical frames and repeated offsets.

They compare the expanded robot with the parameters of its drives and with the conventions of ROS, and yield a finding
for each contradiction.
"""
