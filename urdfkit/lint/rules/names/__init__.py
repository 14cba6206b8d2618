"""Rules for the names of links and joints.

They read the expanded robot and yield a finding for each name that ROS or Gazebo does not accept.
"""
