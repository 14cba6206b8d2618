"""Action servers of controllers: goals, feedback and results over topics, for ROS 1 and ROS 2.

An action server subscribes to goals and publishes their status, feedback and result.
"""
