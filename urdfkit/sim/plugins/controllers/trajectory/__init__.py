"""The joint trajectory controller: messages, splines, tolerances.

The controller subscribes to trajectories and writes joint commands in each control period.
"""
