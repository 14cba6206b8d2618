"""Rules on the package around the description."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.packaging.not_installed import NotInstalled
    from urdfkit.lint.rules.packaging.package_xml_dependency import PackageXmlDependency

    return (
        PackageXmlDependency,
        NotInstalled,
    )
