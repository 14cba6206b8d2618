"""Expressions of xacro, parsed with ``ast`` and interpreted over plain values.

The text of an expression and a scope go in; a number, string, list or dictionary, or a failure, comes out.
"""
