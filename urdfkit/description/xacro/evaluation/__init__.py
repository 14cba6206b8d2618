"""Evaluation: expands documents and computes expressions over plain values, without Python's `eval`.

A xacro file goes in; an `Expanded` comes out, or an error with its place.
"""
