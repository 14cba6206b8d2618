"""Read expanded XML as a robot: links, joints, transmissions and ``<gazebo>`` blocks, with source positions.

Input: an `Element` tree; output: a `Robot` and its problems.
"""
