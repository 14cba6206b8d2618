"""Bridge to ROS 2: the topics of a simulation on the graph of ROS, by rclpy or, without ROS, by Cyclone DDS.

`open_node` selects the library; `NodeBridge` connects its node with the bus of a simulation.
"""
