"""Xacro: a file goes in, an `Expanded` whose elements have the position of their source comes out.

`expand` stops at the first error. `expand_leniently` records each fault for the linter and continues.
"""
