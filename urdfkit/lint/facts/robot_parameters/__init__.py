"""Parameters in YAML that describe the robot itself: lengths, places and orders of its joints.

In go the robot and the YAML files of its packages, out come the values that contradict the robot or each other.
"""
