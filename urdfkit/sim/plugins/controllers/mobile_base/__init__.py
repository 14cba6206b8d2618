"""Controllers of wheeled bases: differential, steering, four-wheel steering, mecanum, with their odometry.

A controller subscribes to velocity commands, writes wheel commands and publishes odometry.
"""
