"""Xacro arguments and files of a robot that the command line does not name.

Input: the robot as named; output: the robot with the arguments of launch files, and notes on arguments and files.
"""
