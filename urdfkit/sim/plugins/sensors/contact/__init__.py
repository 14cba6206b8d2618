"""Contact and force-torque sensors: bumpers, contact sensors, touch sensors and joint wrenches.

Each sensor reads the contacts or joint loads of a step and publishes messages.
"""
