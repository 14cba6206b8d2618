"""Bridge to ROS 2: the topics of a simulation on the graph of ROS, by rclpy or, without ROS, by Cyclone DDS."""
