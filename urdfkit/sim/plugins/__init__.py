"""Gazebo plugins at work: drives, sensors, controllers, and what installs them from a description.

Plugin elements go in; objects that write joint commands and publish messages come out.
"""
