"""Read XML from untrusted files into elements with their source positions.

Text goes in; `Element`, `Position` and `Span` come out, with the start tags as they are written.
"""
