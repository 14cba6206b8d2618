"""Rules on what the robot means: wheels, sides, optical frames."""
