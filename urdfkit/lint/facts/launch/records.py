"""Records of a launch file: its arguments, includes, xacro commands and nodes."""

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.record import field, record

COMPUTED = "\0"
"""Name of arguments with computed names."""

IMPORTED = "\1"
"""Name of arguments that imported modules can declare."""

WITHOUT_COLON = r"(?:(?<=\s)|^)([A-Za-z_]\w*)=(?!=)"
"""Matches the name in a word ``name=value`` of a xacro command."""


@record(eq=False)
class Declared:
    """A declared launch argument.

    Attributes:
        name: its name.
        is_required: whether it has neither a default nor a value.
        is_fixed: whether it has a value that an including file cannot change.
    """

    name: Named
    is_required: bool = False
    is_fixed: bool = False


@record(eq=False)
class Call:
    """An include of a launch file, or a xacro command.

    Attributes:
        package: package of the file; empty if it is computed or the path does not start at a package.
        path: path of the file in the package.
        start: offset of the action.
        end: offset after the action, or after its first tag.
        passed: the arguments that it passes.
        passes_all: whether it may pass more arguments, or names another file than the default of a launch argument.
        without_colon: the words ``name=value`` of a xacro command, which xacro takes for file names.
        is_conditional: whether it is run under a condition only.
    """

    package: str
    path: str
    start: int
    end: int
    passed: tuple[Named, ...]
    passes_all: bool = False
    without_colon: tuple[Named, ...] = ()
    is_conditional: bool = False


@record(eq=False)
class Executable:
    """A node that is started: package and program; None if they are computed."""

    package: Named | None
    program: Named | None


@record(eq=False)
class LaunchActions:
    """The arguments, includes and nodes of a launch file.

    Attributes:
        source: the file.
        is_ros1: whether roslaunch reads it.
        declared: the declared arguments by name; the first of several.
        used: the names of used arguments, and whether the use has a default.
        defaults: the defaults of declared arguments in XML and YAML.
        assigned: names that the file assigns without declaring them.
        includes: the included launch files.
        xacro: the xacro commands.
        nodes: the nodes that are started.
    """

    source: Source
    is_ros1: bool = False
    declared: dict[str, Declared] = field(default_factory=dict)
    used: list[tuple[Named, bool]] = field(default_factory=list)
    defaults: dict[str, str] = field(default_factory=dict)
    assigned: set[str] = field(default_factory=set)
    includes: list[Call] = field(default_factory=list)
    xacro: list[Call] = field(default_factory=list)
    nodes: list[Executable] = field(default_factory=list)

    @property
    def is_computed(self) -> bool:
        """Whether it declares arguments with computed names."""
        return COMPUTED in self.assigned

    @property
    def imports_code(self) -> bool:
        """Whether it imports modules that can declare arguments."""
        return IMPORTED in self.assigned
