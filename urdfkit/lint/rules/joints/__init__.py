"""Rules for joints: types, axes, limits, dynamics and mimic joints.

They read the expanded robot and yield a finding for each defect of a joint.
"""
