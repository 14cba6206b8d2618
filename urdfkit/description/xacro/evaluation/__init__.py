"""Evaluate xacro without Python's `eval`: expressions over plain values, documents into elements with their origins.

A xacro file goes in; an `Expanded` comes out, or an error with its place.
"""

from __future__ import annotations
