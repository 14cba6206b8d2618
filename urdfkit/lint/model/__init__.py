"""The description under lint: the robot, every file it was read from, and the tags exactly as they are written.

Rules and edits read it; nothing here reports a finding.
"""
