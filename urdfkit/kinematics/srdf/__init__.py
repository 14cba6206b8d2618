"""SRDF for MoveIt: groups of joints, end effectors, and pairs of links that need no check for collisions.

A robot and its collision matrix go in; the text of an SRDF comes out, a new one or an old one with these lines changed.
"""

from urdfkit.kinematics.srdf.groups import EndEffector, PlanningGroup, find_groups, group_of_chain
from urdfkit.kinematics.srdf.srdf_text import missing_links, new_srdf, updated_srdf

__all__ = ["EndEffector", "PlanningGroup", "find_groups", "group_of_chain", "missing_links", "new_srdf", "updated_srdf"]
