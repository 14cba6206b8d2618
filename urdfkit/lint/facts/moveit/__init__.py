"""Semantic descriptions (SRDF) of a robot, as MoveIt reads them.

Input: the root elements of SRDF files; output: the groups of joints and the names that the files use.
"""
