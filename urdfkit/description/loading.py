"""load: the strict reader, which raises the most important error of a description with its position."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from urdfkit.description.document_root import check_is_robot
from urdfkit.description.encoding_defects import encoding_repairs
from urdfkit.description.model_argument import model_argument
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.repair_positions import at_attributes
from urdfkit.description.structure_defects import repaired_structure
from urdfkit.description.urdf.parser import parse
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.value_defects import repaired_values, require_valid_values
from urdfkit.description.xacro.declared_arguments import unused_arguments
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xacro.expand import expand as expand_file
from urdfkit.description.xacro.expand import expand_leniently, is_xacro
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.misplaced_declaration import without_declaration
from urdfkit.description.xml.reader import read_source
from urdfkit.description.xml.source import absolute
from urdfkit.errors import ModelError, UsageError, XacroError, XmlError
from urdfkit.resources import ModelArgument


def load(
    robot: Robot | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
    macro: str | None = None,
) -> Robot:
    """Load a robot that is one tree of links and joints.

    Args:
        robot: a ``.urdf`` or ``.xacro`` file, a package folder or the name of a bundled robot. A loaded robot is
            returned unchanged, or loaded again if `arguments` or `package_path` is set.
        arguments: xacro arguments.
        package_path: folders to search for packages first.
        macro: macro of the file to instantiate; `arguments` are its parameters, too.

    Raises:
        UsageError: `robot` is something else, or the file has no such macro or argument.
        ResourceError: no such file, folder or bundled robot.
        XmlError: a file is not well-formed, declares entities, or exceeds a limit.
        XacroError: xacro could not expand it.
        ModelError: the file is not a robot, the links are not a single tree, or a value is invalid.

    Examples:
        >>> import urdfkit
        >>> robot = urdfkit.load("gem_e2", arguments={"velodyne": "false"})
        >>> robot.name, len(robot.links)
        ('gem_e2', 11)
    """
    package_path = tuple(package_path)
    if isinstance(robot, Robot) and not arguments and not package_path and macro is None:
        return robot
    loaded = _load(model_argument(robot, arguments=arguments, package_path=package_path, macro=macro), check)
    refuse_unused(arguments, loaded.files, macro)
    return loaded


def load_valid(model: ModelArgument) -> Robot:
    """Load a robot that needs no repair, and accept xacro arguments that no file uses.

    Raises:
        UrdfkitError: see `load`, or a value needs a repair (`repaired_values`).
    """
    robot = _load(model, check)
    for repair in robot.repairs:
        if repair.severity == "warning":
            raise ModelError(repair.message, position=repair.position)
    require_valid_values(robot)
    return robot


def refuse_unused(arguments: Mapping[str, str] | None, files: Iterable[Path], macro: str | None = None) -> None:
    """Raise for xacro arguments that no file declares or uses.

    Args:
        arguments: the xacro arguments.
        files: the files of the robot.
        macro: the instantiated macro, which uses its parameters.

    Raises:
        UsageError: a file uses no such argument; the message names the nearest one.
    """
    if arguments and (lines := unused_arguments(arguments, [read_source(file) for file in files], macro)):
        raise UsageError(lines[0])


def load_repaired(
    robot: Robot | ModelArgument | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
) -> Robot:
    """Load a robot whose links need not be one valid tree.

    Args:
        robot: see `load`, or the robot argument of a command, which may have xacro arguments that no file uses.
        arguments: xacro arguments.
        package_path: folders to search for packages first.

    Returns:
        A robot that is one valid tree, with the `repairs` that it needed; see `repaired_structure` and
            `repaired_values`. Includes and macros that do not exist are ignored (`without_unknown_values`).

    Raises:
        UsageError: see `load`.
        ResourceError: see `load`.
        XmlError: see `load`.
        XacroError: see `load`.
        ModelError: the file is not a robot, or has no link.
    """
    package_path = tuple(package_path)
    if isinstance(robot, Robot) and not arguments and not package_path:
        return robot
    if not isinstance(robot, ModelArgument):
        robot = model_argument(robot, arguments=arguments, package_path=package_path)
    repaired = _repaired(_load(robot, require_links, repairs=True))
    refuse_unused(arguments, repaired.files)
    return repaired


def repaired_robot_of_text(text: str, *, package_path: Iterable[str | Path] = ()) -> Robot:
    """Return the robot of a URDF document as `load_repaired` does.

    Raises:
        UrdfkitError: see `load_repaired`.
    """
    model = ModelArgument(Path("spawned.urdf"), {}, tuple(Path(folder) for folder in package_path), "spawned")
    return replace(_repaired(_load(model, require_links, text)), files=())


def _repaired(robot: Robot) -> Robot:
    repaired, defects = repaired_structure(robot)
    repaired, values = repaired_values(repaired)
    repairs = (*robot.repairs, *(defect.repair for defect in defects), *values)
    return replace(repaired, repairs=tuple(at_attributes(repairs))) if repairs else repaired


def _load(
    model: ModelArgument, check: Callable[[Robot], None], text: str | None = None, *, repairs: bool = False
) -> Robot:
    """Return the robot of a file, or of a text in its place, after a check; on request with what xacro can expand."""
    packages = Packages(model.package_path, model.path)
    texts = {} if text is None else {str(absolute(model.path)): text}
    if model.macro is not None:
        from urdfkit.description.xacro.macro_call import text_with_call

        texts = text_with_call(model.path, model.macro, model.arguments, packages)
    run_xacro = model.macro is not None or None
    try:
        expanded = expand_file(
            model.path, arguments=model.arguments, packages=packages, run_xacro=run_xacro, texts=texts
        )
    except XacroError:
        partial = _partial(model, packages, texts) if repairs else None
        if partial is None:
            raise
        return partial
    except XmlError as error:
        readable = without_declaration(read_source(model.path).text, error) if repairs and text is None else None
        if readable is None:
            raise
        robot = _load(model, check, readable, repairs=True)
        repair = Repair("structure", "E001", f"{error.message}; it is ignored", error.position)
        return replace(robot, repairs=(repair, *robot.repairs))
    try:
        robot = _parsed(expanded, model.arguments)
        check(robot)
    except ModelError as error:
        if is_xacro(model.path) or not _holds_xacro(expanded):
            raise
        hint = "; xacro is not run on .urdf files: rename it to .urdf.xacro"
        raise ModelError(error.message + hint, position=error.position) from None
    repairs_of_text = encoding_repairs(expanded.sources.values())
    return replace(robot, repairs=repairs_of_text) if repairs_of_text else robot


def _partial(model: ModelArgument, packages: Packages, texts: Mapping[str, str]) -> Robot | None:
    """Return the robot without the includes and macros that do not exist; None if that is no robot."""
    from urdfkit.description.xacro.recovery.missing_parts import without_unknown_values

    expanded = expand_leniently(
        model.path, arguments=model.arguments, packages=packages, run_xacro=True, add_prefixes=False, texts=texts
    )
    repairs = without_unknown_values(expanded)
    if repairs is None or expanded.root is None or expanded.root.tag != "robot":
        return None
    robot = parse(expanded.root, files=expanded.files, packages=packages, arguments=model.arguments)
    repairs = [*encoding_repairs(expanded.sources.values()), *repairs]
    return replace(robot, repairs=tuple(repairs)) if robot.links else None


def expand(
    robot: Robot | str | Path, *, arguments: Mapping[str, str] | None = None, package_path: Iterable[str | Path] = ()
) -> str:
    """Expand xacro to URDF.

    Args:
        robot: see `load`; the file of a loaded robot is read again.
        arguments: xacro arguments.
        package_path: folders to search for packages first.

    Returns:
        The URDF, byte for byte what stock xacro prints.

    Raises:
        UsageError: `robot` is neither a path, a name nor a robot that was loaded from a file, or no file uses one of
            `arguments`.
        ResourceError: no such file, folder or bundled robot.
        XmlError: a file is not well-formed, declares entities, or exceeds a limit.
        XacroError: xacro could not expand it.

    Examples:
        >>> import urdfkit
        >>> urdfkit.expand("simpleton").count("<link ")
        7
    """
    model = model_argument(robot, arguments=arguments, package_path=package_path)
    packages = Packages(model.package_path, model.path)
    expanded = expand_file(model.path, arguments=model.arguments, packages=packages, run_xacro=True)
    refuse_unused(arguments, expanded.files)
    return expanded.xml


def _parsed(expanded: Expanded, arguments: Mapping[str, str]) -> Robot:
    """Return the robot that an expanded file describes, unchecked.

    Raises:
        ModelError: the file is not a robot.
    """
    root = expanded.root
    if root is None:
        raise ModelError(f"{expanded.path} could not be read")
    check_is_robot(root)
    if expanded.macros and not any(child.tag in ("link", "joint") for child in root.children):
        from urdfkit.description.xacro.macro_call import listed

        raise ModelError(
            f"the file defines macros only: {listed(expanded)}; instantiate one with --macro NAME and its parameters "
            "as key:=value",
            position=root.origin.position,
        )
    return parse(root, files=expanded.files, packages=expanded.packages, arguments=arguments)


def _holds_xacro(expanded: Expanded) -> bool:
    return any("${" in source.text or "<xacro:" in source.text for source in expanded.sources.values())


def check(robot: Robot) -> None:
    """Raise the most important error of a robot that is not a single valid tree.

    Args:
        robot: the robot returned by `parse`.

    Raises:
        ModelError: the error, with its source position.
    """
    require_links(robot)
    _, defects = repaired_structure(robot)
    if defects:
        raise defects[0].error


def require_links(robot: Robot) -> None:
    """Raise unless a robot has a link.

    Raises:
        ModelError: the robot has no link.
    """
    if not robot.links:
        origin = robot.element.origin
        raise ModelError("the robot has no link" + chain_words(origin.expansions), position=origin.position)
