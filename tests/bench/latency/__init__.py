"""Time from a command to the odometry that shows it, over the bridges."""
