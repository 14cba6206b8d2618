"""Controllers of single joints and groups: forward commands, PID, grippers, the joint state broadcaster.

A controller reads commands and joint states and writes position, velocity or effort commands.
"""
