"""The table of rules: what a file or a robot must have for a rule to find anything, its module and its class.

A small model needs a third of the rules; the others are not imported. In the first column are words, one of which must
be there, or nothing where the rule is always asked. For a `SourceRule` they are texts in any file, or, after a star,
endings of file names; for a `RobotRule` they are among the `traits` of the robot.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.robot import Robot

Row = tuple[str, str, str]

SOURCE: tuple[Row, ...] = (
    ("", "document.unbound_namespace_prefix", "UnboundNamespacePrefix"),
    ("xmlns:xacro", "document.wrong_xacro_namespace_uri", "WrongXacroNamespaceUri"),
    (
        "<macro <property <include <arg <if <unless <insert_block",
        "xacro.unprefixed_directive",
        "UnprefixedDirective",
    ),
    ("macro", "xacro.unprefixed_macro_call", "UnprefixedMacroCall"),
    ("", "xacro.rounded_pi", "RoundedPi"),
    ("load_yaml", "xacro.deprecated_call", "DeprecatedCall"),
    ("xacro:include", "xacro.include_with_parameters", "IncludeWithParameters"),
    ("<inertia", "xacro.inertia_formula", "InertiaFormula"),
    ("<inertial", "xacro.inertia_arguments", "InertiaArguments"),
    ("*.urdf", "xacro.xacro_in_plain_urdf", "XacroInPlainUrdf"),
)

FAULTS: tuple[Row, ...] = (
    ("", "document.xml_not_well_formed", "XmlNotWellFormed"),
    ("", "xacro.unknown_macro", "UnknownMacro"),
    ("", "xacro.undefined_property", "UndefinedProperty"),
    ("", "xacro.property_used_before_definition", "PropertyUsedBeforeDefinition"),
    ("", "xacro.undefined_argument", "UndefinedArgument"),
    ("", "xacro.macro_args_mismatch", "MacroArgsMismatch"),
    ("", "xacro.include_not_found", "IncludeNotFound"),
    ("", "xacro.include_cycle", "IncludeCycle"),
    ("", "xacro.conditional_not_boolean", "ConditionalNotBoolean"),
    ("", "xacro.expression_error", "ExpressionError"),
    ("", "xacro.expansion_error", "ExpansionError"),
    ("", "xacro.too_large", "TooLarge"),
    ("", "xacro.directive_attribute", "DirectiveAttribute"),
)

SUPPRESSION: tuple[Row, ...] = (
    ("", "document.unknown_suppression", "UnknownSuppression"),
    ("", "document.unused_suppression", "UnusedSuppression"),
)

ROBOT: tuple[Row, ...] = (
    ("", "document.robot_name_missing", "RobotNameMissing"),
    ("", "document.unexpected_text", "UnexpectedText"),
    ("", "document.unknown_element", "UnknownElement"),
    ("", "document.unknown_attribute", "UnknownAttribute"),
    ("bad-number!", "document.bad_number", "BadNumber"),
    ("wrong-arity!", "document.wrong_arity", "WrongArity"),
    ("", "document.nan_or_inf", "NanOrInf"),
    ("", "document.duplicate_singleton_element", "DuplicateSingletonElement"),
    ("missing!", "document.required_missing", "RequiredMissing"),
    ("", "document.stray_quote", "StrayQuote"),
    ("origin", "document.rpy_in_degrees", "RpyInDegrees"),
    ("plugin sensor", "document.plugin_outside_gazebo", "PluginOutsideGazebo"),
    ("", "xacro.unexpanded_expression", "UnexpandedExpression"),
    ("dangling!", "tree.parent_link_undefined", "ParentLinkUndefined"),
    ("dangling!", "tree.child_link_undefined", "ChildLinkUndefined"),
    ("roots!", "tree.multiple_roots", "MultipleRoots"),
    ("joint", "tree.no_root_or_cycle", "NoRootOrCycle"),
    ("parents!", "tree.multiple_parents", "MultipleParents"),
    ("same-name!", "tree.duplicate_link", "DuplicateLink"),
    ("same-name!", "tree.duplicate_joint", "DuplicateJoint"),
    ("same-name!", "names.link_joint_same_name", "LinkJointSameName"),
    ("", "names.invalid_name_characters", "InvalidNameCharacters"),
    ("", "names.reserved_sdf_name", "ReservedSdfName"),
    ("", "packaging.package_xml_dependency", "PackageXmlDependency"),
    ("", "packaging.not_installed", "NotInstalled"),
    ("type=None", "joints.joint_type_missing", "JointTypeMissing"),
    ("type=unknown", "joints.joint_type_unknown", "JointTypeUnknown"),
    ("type=revolute type=prismatic", "joints.limit_missing", "LimitMissing"),
    ("limit", "joints.limit_effort_or_velocity_missing", "LimitEffortOrVelocityMissing"),
    ("limit", "joints.limit_lower_above_upper", "LimitLowerAboveUpper"),
    ("limit", "joints.limit_equal", "LimitEqual"),
    ("limit", "joints.limits_in_degrees", "LimitsInDegrees"),
    ("limit", "joints.effort_or_velocity_zero", "EffortOrVelocityZero"),
    ("limit", "joints.negative_effort_or_velocity", "NegativeEffortOrVelocity"),
    ("axis", "joints.axis_zero", "AxisZero"),
    ("axis", "joints.axis_not_normalised", "AxisNotNormalised"),
    ("movable!", "joints.axis_missing", "AxisMissing"),
    ("cylinder", "joints.axis_not_along_wheel", "AxisNotAlongWheel"),
    ("limit", "joints.continuous_with_position_limits", "ContinuousWithPositionLimits"),
    ("mimic", "joints.mimic_joint_undefined", "MimicJointUndefined"),
    ("type=fixed", "joints.axis_or_limit_on_fixed", "AxisOrLimitOnFixed"),
    ("dynamics", "joints.dynamics_empty_or_negative", "DynamicsEmptyOrNegative"),
    ("safety_controller", "joints.safety_controller_inconsistent", "SafetyControllerInconsistent"),
    ("mass", "inertial.mass_nonpositive", "MassNonpositive"),
    ("inertia", "inertial.inertia_not_positive_definite", "InertiaNotPositiveDefinite"),
    ("inertia", "inertial.inertia_triangle_inequality", "InertiaTriangleInequality"),
    ("inertia", "inertial.inertia_zero", "InertiaZero"),
    ("inertia", "inertial.inertia_transposed", "InertiaTransposed"),
    ("inertia", "inertial.inertia_decimal_slip", "InertiaDecimalSlip"),
    ("inertia", "inertial.inertia_too_large", "InertiaTooLarge"),
    ("inertia", "inertial.inertia_too_small", "InertiaTooSmall"),
    ("inertia", "inertial.inertia_identity", "InertiaIdentity"),
    ("inertia", "inertial.inertia_copy_paste", "InertiaCopyPaste"),
    ("joint", "inertial.moving_link_without_inertial", "MovingLinkWithoutInertial"),
    ("collision", "inertial.collision_without_inertial", "CollisionWithoutInertial"),
    ("inertial", "inertial.com_outside_geometry", "ComOutsideGeometry"),
    ("mass", "inertial.mass_vs_volume", "MassVsVolume"),
    ("collision", "geometry.visual_without_collision", "VisualWithoutCollision"),
    ("box cylinder sphere capsule", "geometry.nonpositive_primitive", "NonpositivePrimitive"),
    ("material", "geometry.material_undefined", "MaterialUndefined"),
    ("color", "geometry.rgba_out_of_range", "RgbaOutOfRange"),
    ("cylinder sphere", "geometry.wheel_off_its_axis", "WheelOffItsAxis"),
    ("mesh", "geometry.mesh_file_missing", "MeshFileMissing"),
    ("mesh", "geometry.mesh_package_unknown", "MeshPackageUnknown"),
    ("mesh", "geometry.mesh_absolute_path", "MeshAbsolutePath"),
    ("mesh", "geometry.mesh_scale_suspect", "MeshScaleSuspect"),
    ("mesh", "geometry.mesh_format_unsupported", "MeshFormatUnsupported"),
    ("mesh", "geometry.mesh_corrupt", "MeshCorrupt"),
    ("mesh", "geometry.collada_up_axis", "ColladaUpAxis"),
    ("plugin", "semantics.wheel_separation", "WheelSeparation"),
    ("plugin", "semantics.wheel_diameter", "WheelDiameter"),
    ("plugin", "semantics.left_right_swapped", "LeftRightSwapped"),
    ("optical!", "semantics.optical_frame", "OpticalFrame"),
    ("type=fixed", "semantics.double_offset", "DoubleOffset"),
    ("gazebo", "gazebo.gazebo_reference_undefined", "GazeboReferenceUndefined"),
    ("plugin", "gazebo.plugin_joint_undefined", "PluginJointUndefined"),
    ("plugin", "gazebo.plugin_link_undefined", "PluginLinkUndefined"),
    ("plugin sensor", "gazebo.sensor_frame_undefined", "SensorFrameUndefined"),
    ("plugin", "gazebo.plugin_param_unknown", "PluginParamUnknown"),
    ("plugin", "gazebo.plugin_param_wrong_generation", "PluginParamWrongGeneration"),
    ("plugin", "gazebo.plugin_name_case", "PluginNameCase"),
    ("plugin", "gazebo.plugin_filename_malformed", "PluginFilenameMalformed"),
    ("plugin", "gazebo.plugin_unknown", "PluginUnknown"),
    ("gazebo", "gazebo.gazebo_unknown_tag", "GazeboUnknownTag"),
    ("sensor visual collision surface", "gazebo.value_attribute_in_sdf", "ValueAttributeInSdf"),
    ("fdir1", "gazebo.friction_direction_zero", "FrictionDirectionZero"),
    ("cfmDamping", "gazebo.deprecated_gazebo_tag", "DeprecatedGazeboTag"),
    ("plugin sensor", "gazebo.fixed_joint_lumping", "FixedJointLumping"),
    ("plugin sensor", "gazebo.duplicate_sensor_or_plugin", "DuplicateSensorOrPlugin"),
    ("gazebo", "gazebo.conflicting_blocks", "ConflictingBlocks"),
    ("sensor plugin", "gazebo.sensor_range_invalid", "SensorRangeInvalid"),
    ("material", "gazebo.gazebo_material_unknown", "GazeboMaterialUnknown"),
    ("plugin transmission", "control.two_drivers", "TwoDrivers"),
    ("transmission", "control.transmission_joint_undefined", "TransmissionJointUndefined"),
    ("transmission", "control.transmission_interface_missing", "TransmissionInterfaceMissing"),
    ("transmission", "control.hardware_interface_unknown", "HardwareInterfaceUnknown"),
    ("transmission", "control.hardware_interface_unprefixed", "HardwareInterfaceUnprefixed"),
    ("transmission", "control.old_transmission_syntax", "OldTransmissionSyntax"),
    ("transmission", "control.transmission_type_unknown", "TransmissionTypeUnknown"),
    ("ros2_control", "control.ros2_control_type_unknown", "Ros2ControlTypeUnknown"),
    ("ros2_control", "control.ros2_control_joint_undefined", "Ros2ControlJointUndefined"),
    ("ros2_control", "control.ros2_control_in_gazebo", "Ros2ControlInGazebo"),
    ("ros2_control", "control.ros2_control_hardware", "HardwareMismatch"),
    ("ros2_control", "control.interface_combination", "InterfaceCombination"),
)

AROUND: tuple[Row, ...] = (
    ("", "packaging.launch_path_missing", "LaunchPathMissing"),
    ("", "packaging.controller_joint_undefined", "ControllerJointUndefined"),
    ("", "packaging.spawned_controller_undefined", "SpawnedControllerUndefined"),
)
"""Rules on the robot that are asked where there are launch files or YAML around it."""

TARGETED: tuple[Row, ...] = (
    ("inertial", "tree.root_link_has_inertia", "RootLinkHasInertia"),
    ("plugin", "gazebo.plugin_lib_wrong_generation", "PluginLibWrongGeneration"),
    ("sensor", "gazebo.sensor_type_deprecated", "SensorTypeDeprecated"),
    ("material", "gazebo.gazebo_material", "GazeboMaterial"),
    ("transmission", "control.transmission_in_ros2", "TransmissionInRos2"),
)
"""Rules on the robot that are asked for some targets only."""


def traits(robot: Robot) -> set[str]:
    """Return what a robot has: its tags, the types of its joints, and, with ``!``, what is odd about it as a whole."""
    found = {element.tag for element in robot.element.walk()}
    found.update(f"{problem.kind}!" for problem in robot.problems)
    from urdfkit.description.robot import JOINT_TYPES

    children = []
    for joint in robot.joints:
        kind = joint.type
        found.add(f"type={kind}" if kind is None or kind in JOINT_TYPES else "type=unknown")
        if joint.is_movable:
            found.add("movable!")
        child, parent = joint.child, joint.parent
        if child is not None:
            children.append(child)
            if "optical" in child.lower():
                found.add("optical!")
        if parent not in robot.link_by_name or child not in robot.link_by_name:
            found.add("dangling!")
    if len(set(children)) < len(children):
        found.add("parents!")
    names = {*robot.link_by_name, *robot.joint_by_name}
    if len(names) < len(robot.links) + len(robot.joints):
        found.add("same-name!")
    if len(robot.link_by_name.keys() - set(children)) != 1:
        found.add("roots!")
    return found
