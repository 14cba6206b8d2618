"""Misspelt classes of plugins, keys of classes, and topics of costmaps."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint.engine.checker import model_of
from urdfkit.lint.facts.control.yaml_tree import nodes
from urdfkit.lint.facts.plugins.class_names import misspelt_classes
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.options import Options


@pytest.fixture
def model(tmp_path: Path) -> Model:
    (tmp_path / "cart.urdf").write_text('<robot name="cart"><link name="base"/></robot>')
    return model_of(tmp_path / "cart.urdf", Options())


def messages(text: str, model: Model) -> list[str]:
    """Return the messages for a YAML file."""
    return [m for node in nodes(Source("filters.yaml", text)) for _, m in misspelt_classes(node, model)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("type: laser_filters/LaserScanRnageFilter", "did you mean `laser_filters/LaserScanRangeFilter`"),
        ("base_global_planner: golbal_planner/GlobalPlanner", "did you mean `global_planner/GlobalPlanner`"),
        ("plugins: [{name: obstacles, type: 'costmap_2d::ObstacleLaye'}]", "did you mean `costmap_2d::ObstacleLayer`"),
        ("tpye: diagnostic_aggregator/GenericAnalyzer", "did you mean `type`"),
        ("footprint_topic: local_costmap/publishd_footprint", "did you mean `local_costmap/published_footprint`"),
        ("costmap_topic: /locl_costmap/costmap_raw", "did you mean `/local_costmap/costmap_raw`"),
    ],
)
def test_a_slip_is_reported(text: str, expected: str, model: Model) -> None:
    (found,) = messages(text, model)
    assert expected in found


@pytest.mark.parametrize(
    "text",
    [
        "type: laser_filters/LaserScanRangeFilter",
        "type: my_filters/LaserScanRingFilter",
        "plugin: nav2_navfn_planner/NavfnPlanner",
        "planner: mission/Planner\ntype: mission/Other",
        "costmap_topic: front_costmap/costmap_raw",
    ],
)
def test_other_classes_and_topics_are_accepted(text: str, model: Model) -> None:
    assert messages(text, model) == []
