"""Rules for the ROS package of the robot: package.xml, launch files, controller parameters and bridges.

They compare these files, and those of neighbouring packages that depend on the package, with the expanded robot, and
yield a finding for each contradiction.
"""
