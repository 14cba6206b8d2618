"""Scope of a lint run: the entry files below a folder, their settings, and the target of the robot.

Paths and options go in; entry files, settings and the selection of rules come out.
"""
