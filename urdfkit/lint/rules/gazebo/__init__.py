"""Rules on Gazebo tags and plugins."""
