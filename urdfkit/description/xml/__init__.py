"""Read XML from untrusted files into elements that know their place.

Text goes in; `Element`, `Position` and `Span` come out, with the start tags as they are written.
"""
