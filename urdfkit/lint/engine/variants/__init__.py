"""Variants of a robot: xacro arguments other than the default ones, with which it is linted too.

Launch files pass some of them. The others select branches of conditions that no other variant expands.
"""
