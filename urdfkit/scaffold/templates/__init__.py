"""Templates and the answers to their questions: read, check, compute, substitute.

A template folder and answers go in; checked answers and filled text come out.
"""
