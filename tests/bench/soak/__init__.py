"""Robots driven at random through a house for a long time, and what must hold all the while."""
