"""Values of a description, followed to the places where they are written.

Input: source text with expressions, and a `Model`; output: literals with source positions.
"""
