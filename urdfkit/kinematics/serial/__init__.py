"""Serial chains: the joints between two links, and inverse kinematics of single targets without numpy.

A robot and two links go in; constants of the compiled kernel and joint positions come out.
"""
