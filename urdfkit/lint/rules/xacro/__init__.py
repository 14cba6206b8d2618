"""Rules for xacro: directives, macros, properties, arguments, includes and expressions.

They read the source files and the errors of their expansion, and yield a finding at the place in the source.
"""
