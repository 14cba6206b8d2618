"""Misspelt classes of plugins, keys of classes, and topics of costmaps in YAML files.

Sources: the plugin descriptions of laser_filters, diagnostic_aggregator, MoveIt, kinematics_interface, ros-planning
navigation (Noetic) and navigation2; nav2_costmap_2d (costmap_2d_publisher.cpp, footprint_subscriber.cpp).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache, lru_cache

from urdfkit.defect_message import Suggestion
from urdfkit.description.control.controller_types import TYPES
from urdfkit.lint.facts.control.exported_plugins import is_exported_plugin
from urdfkit.lint.facts.control.yaml_tree import Node
from urdfkit.lint.facts.navigation.tables import PLUGINS
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Node, str]]

_OTHERS = """
clear_costmap_recovery/ClearCostmapRecovery costmap_2d::InflationLayer costmap_2d::ObstacleLayer
costmap_2d::StaticLayer costmap_2d::VoxelLayer diagnostic_aggregator/AnalyzerGroup
diagnostic_aggregator/GenericAnalyzer diagnostic_aggregator/IgnoreAnalyzer dwa_local_planner/DWAPlannerROS
base_local_planner/TrajectoryPlannerROS carrot_planner/CarrotPlanner eband_local_planner/EBandPlannerROS
global_planner/GlobalPlanner navfn/NavfnROS rotate_recovery/RotateRecovery move_slow_and_clear/MoveSlowAndClear
teb_local_planner/TebLocalPlannerROS kdl_kinematics_plugin/KDLKinematicsPlugin
lma_kinematics_plugin/LMAKinematicsPlugin kinematics_interface_kdl/KinematicsInterfaceKDL
laser_filters/InterpolationFilter laser_filters/LaserArrayFilter laser_filters/LaserMedianSpatialFilter
laser_filters/LaserScanAngularBoundsFilter laser_filters/LaserScanAngularBoundsFilterInPlace
laser_filters/LaserScanBoxFilter laser_filters/LaserScanFootprintFilter laser_filters/LaserScanIntensityFilter
laser_filters/LaserScanMaskFilter laser_filters/LaserScanPolygonFilter laser_filters/LaserScanRangeFilter
laser_filters/LaserScanSpeckleFilter laser_filters/ScanBlobFilter laser_filters/ScanShadowsFilter
laser_filters/SectorFilter occupancy_map_monitor/DepthImageOctomapUpdater
occupancy_map_monitor/PointCloudOctomapUpdater online_signal_smoothing::ButterworthFilterPlugin
opennav_docking::SimpleChargingDock opennav_docking::SimpleNonChargingDock
"""
_CLASS = r"[a-z]\w*(?:/|::)[A-Z]\w+"
_KEYS = ("type", "plugin")
_TOPICS = tuple(
    f"{name}_costmap/{topic}"
    for name in ("local", "global")
    for topic in ("costmap", "costmap_raw", "costmap_updates", "published_footprint", "footprint", "voxel_grid")
)


@cache
def _classes() -> dict[int, tuple[str, ...]]:
    """Return the classes of plugins with `/`, by the number of their letters."""
    found: dict[int, tuple[str, ...]] = {}
    for name in sorted({each.replace("::", "/") for each in (*PLUGINS, *TYPES, *_OTHERS.split())}):
        found[len(name)] = (*found.get(len(name), ()), name)
    return found


@lru_cache(maxsize=4000)
def _nearest_class(name: str) -> str:
    """Return the class that a name differs from by a slip; empty for a known class."""
    if name in _classes().get(len(name), ()):
        return ""
    near = (each for length in range(len(name) - 1, len(name) + 2) for each in _classes().get(length, ()))
    return next((each for each in near if is_slip(name, each)), "")


def misspelt_classes(node: Node, model: Model) -> Defects:
    """Yield the classes and topics of costmaps in a group that differ by a slip from known ones, and their keys."""
    keys = {key.text for key, _ in node.entries}
    for key, value in node.entries:
        for item in (value, *value.items):
            if item.kind != "text":
                continue
            if re.fullmatch(_CLASS, item.text):
                kind = item.text.replace("::", "/")
                near = _nearest_class(kind)
                right = near.replace("/", "::") if "::" in item.text else near
                if near and not is_exported_plugin(model, kind):
                    yield item, f"unknown plugin `{item.text}`" + Suggestion(right, item.text)
            elif "costmap/" in item.text or item.text.endswith(_ENDS):
                name = item.text.strip("/")
                near = "" if name in _TOPICS else next((each for each in _TOPICS if is_slip(name, each)), "")
                if near:
                    right = item.text.replace(name, near)
                    yield item, f"unknown topic `{item.text}` of a costmap" + Suggestion(right, item.text)
        if value.kind == "text" and re.fullmatch(_CLASS, value.text) and keys.isdisjoint(_KEYS):
            meant = next((each for each in _KEYS if key.text not in keys - {key.text} and is_slip(key.text, each)), "")
            if meant:
                yield key, f"unknown key `{key.text}` of the class of a plugin" + Suggestion(meant, key.text)


_ENDS = ("/costmap_raw", "/published_footprint")
