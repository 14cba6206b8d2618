"""Rules for the kinematic tree: parents, children, roots, loops and duplicate names.

They read the expanded robot and yield a finding for each link or joint that breaks the tree.
"""
