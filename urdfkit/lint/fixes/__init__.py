"""Apply fixes to source text and keep them only where linting again finds nothing worse.

Findings with edits go in; changed files come out.
"""
