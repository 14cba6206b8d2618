"""The compiled kernel of serial chains: forward kinematics, Jacobians and inverse kinematics.

The constants of a chain go in as numbers; placements, Jacobians and configurations come out. Python's lock is released.
"""
