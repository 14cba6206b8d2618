"""Lidars and range finders.

Each sensor casts rays into the current scene and publishes LaserScan, Range, PointCloud or PointCloud2 messages.
"""
