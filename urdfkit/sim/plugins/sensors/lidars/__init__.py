"""Lidars and range finders.

The scene as it stands goes in; LaserScan, Range and PointCloud2 messages come out.
"""
