"""Apply fixes to source text and keep them only where linting again finds nothing worse.

Input: findings with edits; output: changed files.
"""
