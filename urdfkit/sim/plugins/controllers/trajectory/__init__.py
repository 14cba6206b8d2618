"""The joint trajectory controller: messages, splines, tolerances.

A trajectory goes in; joint commands over time come out.
"""
