"""Write packages from a template, and write them again in place after a change of template or answers.

A template and a recipe go in; files come out, all or none.
"""
