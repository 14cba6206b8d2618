"""Sensors of touch and load: bumpers, contact sensors, force and torque at a joint.

Contacts and joint loads of a step go in; messages come out.
"""
