"""Read expanded XML as a robot: links, joints, transmissions and ``<gazebo>`` blocks, each with its place.

An `Element` tree goes in; a `Robot` and its problems come out.
"""
