"""Commands that compute poses, positions and motions of links and joints.

Command lines go in; text, JSON or files come out.
"""
