"""Recovery: expands files that are wrong, for the linter and editors.

Input: a file and its arguments. Output: an `Expanded` with the elements that could be expanded, and a `Fault` for each
failure. Each failing element is dropped or repaired in memory.
"""
