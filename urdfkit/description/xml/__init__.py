"""Read XML from untrusted files into elements with their source positions.

Input: text; output: `Element`, `Position`, `Span` and the start tags in the source.
"""
