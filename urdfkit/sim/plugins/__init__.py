"""Simulated Gazebo plugins: drives, sensors and controllers, and their installation from a description.

The installer makes an object of each plugin element; the objects write joint commands and publish messages.
"""
