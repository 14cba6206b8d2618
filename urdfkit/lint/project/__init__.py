"""Scope of a lint run: the entry files below a folder, their settings, and the target of the robot.

Input: paths and options; output: entry files, settings and the rule selection.
"""
