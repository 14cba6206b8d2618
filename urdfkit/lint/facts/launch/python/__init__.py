"""Python launch files: classes and their arguments, actions, names and values.

Input: the syntax tree of a launch file; output: its actions, its names, and the places and messages of wrong calls.
"""
