"""Rules on the package around the description."""
