"""The reach map of a chain: which share of orientations the tip reaches in each cell of a grid.

A chain goes in; scores and manipulability by cell come out, and files of them.
"""

from urdfkit.kinematics.reach.base_placement import BasePlacement, base_placement
from urdfkit.kinematics.reach.map_files import write_map
from urdfkit.kinematics.reach.orientations import cone_orientations, down_orientations, uniform_orientations
from urdfkit.kinematics.reach.reach_map import ReachMap, reach_map

__all__ = [
    "BasePlacement",
    "ReachMap",
    "base_placement",
    "cone_orientations",
    "down_orientations",
    "reach_map",
    "uniform_orientations",
    "write_map",
]
