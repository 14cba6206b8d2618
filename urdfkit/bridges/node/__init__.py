"""A node on the graph of ROS 1 or ROS 2, and the bridge of a simulation that uses it.

Bytes of messages and the topics of the graph go through `Node`; what differs between the two is in its implementations.
"""
