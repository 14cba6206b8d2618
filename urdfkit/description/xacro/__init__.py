"""Xacro: a file goes in, an `Expanded` whose elements know their place in the source comes out.

`expand` stops at the first error. `expand_leniently` records each fault for the linter and continues.
"""
