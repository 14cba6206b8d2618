"""Controllers, launch files and bridges around a description, read without running anything.

YAML and launch files go in; controllers, joints, interfaces and nodes with their places come out.
"""
