"""The linted description: the robot, every file it was read from, and the source tags.

Rules and edits read the model; this package reports no findings.
"""
