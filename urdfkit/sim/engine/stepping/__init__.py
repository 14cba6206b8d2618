"""The step of a world: robots, free bodies and what they meet, island by island."""
