"""Rules on shapes, meshes and materials."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.geometry.material_undefined import MaterialUndefined
    from urdfkit.lint.rules.geometry.nonpositive_primitive import NonpositivePrimitive
    from urdfkit.lint.rules.geometry.rgba_out_of_range import RgbaOutOfRange
    from urdfkit.lint.rules.geometry.visual_without_collision import VisualWithoutCollision
    from urdfkit.lint.rules.geometry.wheel_off_its_axis import WheelOffItsAxis

    return (
        VisualWithoutCollision,
        NonpositivePrimitive,
        MaterialUndefined,
        RgbaOutOfRange,
        WheelOffItsAxis,
    )


def mesh_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on meshes."""
    from urdfkit.lint.rules.geometry.collada_up_axis import ColladaUpAxis
    from urdfkit.lint.rules.geometry.mesh_absolute_path import MeshAbsolutePath
    from urdfkit.lint.rules.geometry.mesh_corrupt import MeshCorrupt
    from urdfkit.lint.rules.geometry.mesh_file_missing import MeshFileMissing
    from urdfkit.lint.rules.geometry.mesh_format_unsupported import MeshFormatUnsupported
    from urdfkit.lint.rules.geometry.mesh_package_unknown import MeshPackageUnknown
    from urdfkit.lint.rules.geometry.mesh_scale_suspect import MeshScaleSuspect

    return (
        MeshFileMissing,
        MeshPackageUnknown,
        MeshAbsolutePath,
        MeshScaleSuspect,
        MeshFormatUnsupported,
        MeshCorrupt,
        ColladaUpAxis,
    )
