"""Rules on transmissions and ros2_control."""
