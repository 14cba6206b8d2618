"""Rules on Gazebo tags and plugins."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.gazebo.conflicting_blocks import ConflictingBlocks
    from urdfkit.lint.rules.gazebo.deprecated_gazebo_tag import DeprecatedGazeboTag
    from urdfkit.lint.rules.gazebo.duplicate_sensor_or_plugin import DuplicateSensorOrPlugin
    from urdfkit.lint.rules.gazebo.fixed_joint_lumping import FixedJointLumping
    from urdfkit.lint.rules.gazebo.friction_direction_zero import FrictionDirectionZero
    from urdfkit.lint.rules.gazebo.gazebo_reference_undefined import GazeboReferenceUndefined
    from urdfkit.lint.rules.gazebo.gazebo_unknown_tag import GazeboUnknownTag
    from urdfkit.lint.rules.gazebo.plugin_filename_malformed import PluginFilenameMalformed
    from urdfkit.lint.rules.gazebo.plugin_joint_undefined import PluginJointUndefined
    from urdfkit.lint.rules.gazebo.plugin_link_undefined import PluginLinkUndefined
    from urdfkit.lint.rules.gazebo.plugin_name_case import PluginNameCase
    from urdfkit.lint.rules.gazebo.plugin_param_unknown import PluginParamUnknown
    from urdfkit.lint.rules.gazebo.plugin_param_wrong_generation import PluginParamWrongGeneration
    from urdfkit.lint.rules.gazebo.sensor_frame_undefined import SensorFrameUndefined
    from urdfkit.lint.rules.gazebo.value_attribute_in_sdf import ValueAttributeInSdf

    return (
        GazeboReferenceUndefined,
        PluginJointUndefined,
        PluginLinkUndefined,
        SensorFrameUndefined,
        PluginParamUnknown,
        PluginParamWrongGeneration,
        PluginNameCase,
        PluginFilenameMalformed,
        GazeboUnknownTag,
        ValueAttributeInSdf,
        FrictionDirectionZero,
        DeprecatedGazeboTag,
        FixedJointLumping,
        DuplicateSensorOrPlugin,
        ConflictingBlocks,
    )


def targeted_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules that are asked for some targets only."""
    from urdfkit.lint.rules.gazebo.gazebo_material import GazeboMaterial
    from urdfkit.lint.rules.gazebo.plugin_lib_wrong_generation import PluginLibWrongGeneration
    from urdfkit.lint.rules.gazebo.sensor_type_deprecated import SensorTypeDeprecated

    return (
        PluginLibWrongGeneration,
        SensorTypeDeprecated,
        GazeboMaterial,
    )
