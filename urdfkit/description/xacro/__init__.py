"""Expand xacro with stock xacro, traced: a file goes in, a tree whose elements know their source comes out.

After a fault the expansion continues where it can, and each fault is recorded for the linter.
"""
