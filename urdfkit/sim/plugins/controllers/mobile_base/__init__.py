"""Controllers of wheeled bases: differential, steering, four-wheel steering, mecanum, with their odometry.

A velocity command goes in; wheel commands and odometry messages come out.
"""
