"""Runs without a page: the options of a run, its commands, and expressions of the robot's state."""
