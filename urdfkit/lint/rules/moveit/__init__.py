"""Rules on MoveIt: the semantic description (SRDF) of a robot, and the MoveIt settings in YAML.

They compare these files with the expanded robot and with each other.
"""
