"""What several rules need to know of a robot, worked out once: features, neighbouring names, root causes.

A `Model` goes in; plain facts come out, with their places, and no findings.
"""
