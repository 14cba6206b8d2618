"""Writing packages from a template, and updating them in place when the template or the answers change.

A template and a recipe go in; files come out, all or none.
"""
