"""Solve the rows of one robot directly: Newton's method on which rows hold and where contacts slide.

Rows and the Delassus matrix go in; impulses come out.
"""
