"""L109 launch-element-invalid."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.xml_elements import (
    ACTIONS,
    ANY,
    ELEMENTS,
    OTHER_ELEMENTS,
    OTHER_SUBSTITUTIONS,
    OTHER_WORDS,
    SUBSTITUTIONS,
)
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.tags import Attribute, Document, Tag
from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchElementInvalid(RobotRule):
    """An XML or YAML launch file has an unknown element or attribute, or lacks a required attribute.

    ## What it does
    Compares elements, attributes and substitutions with the syntax of roslaunch for packages built by catkin, and with
    the syntax of launch_xml for packages built by ament. In ROS 2, packages can add actions, so unknown elements are
    reported only if they are misspelt, belong to ROS 1, or are in an element with fixed contents such as ``<node>``. In
    YAML, the rule checks actions, the keys of actions, parameters, remappings, arguments and substitutions.

    ## Why is this bad?
    The launch stops with "Unexpected attribute(s)" or "missing required attribute". roslaunch ignores unknown elements
    with a warning, so the node or the parameter is missing.

    ## Example
    ```diff
     <launch>
    -  <node name="rviz" pkg="rviz" typ="rviz"/>
    +  <node name="rviz" pkg="rviz" type="rviz"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.

    ## References
    https://wiki.ros.org/roslaunch/XML, and
    https://docs.ros.org/en/jazzy/How-To-Guides/Migrating-from-ROS1/Migrating-Launch-Files.html.
    """

    code = "L109"
    name = "launch-element-invalid"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown element, attribute and substitution, and for missing attributes."""
        from urdfkit.lint.facts.launch.ros_version import ros_version
        from urdfkit.lint.facts.packaging.build_files import is_well_formed

        for name, source in model.related_files.items():
            if name.endswith((".launch.yaml", "_launch.yaml")):
                yield from self._yaml(source)
            if not name.endswith((".launch", ".launch.xml", "_launch.xml")):
                continue
            roots = [tag for tag in Document(source).roots if tag.name == "launch"] if is_well_formed(source) else []
            version = ros_version(source) if roots else 0
            if version:
                yield from self._substitutions(source, version)
                for root in roots:
                    for tag in root.walk():
                        yield from self._tag(source, tag, version)

    def _yaml(self, source: Source) -> Findings:
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.launch.yaml_elements import yaml_launch_defects

        for node, message in yaml_launch_defects(source):
            yield self.at_span(span_of(source, node), message)
        yield from self._substitutions(source, 2)

    def _substitutions(self, source: Source, version: int) -> Findings:
        import re

        from urdfkit.lint.facts.control.launch_package_paths import uncommented

        others, defined = OTHER_SUBSTITUTIONS[version], SUBSTITUTIONS[version]
        for use in re.finditer(r"\$\(([\w-]+)(?=[\s)])", uncommented(source)):
            if use[1] in others:
                message = f"unknown substitution `{use[1]}` in ROS {version}" + Suggestion(others[use[1]], use[1])
                yield self._at(source, use.span(1), message)
            elif use[1] not in defined and (near := nearest(use[1], defined, cutoff=0.6)) is not None:
                yield self._at(source, use.span(1), f"unknown substitution `{use[1]}`" + Suggestion(near, use[1]))
        # launch reports an unclosed ROS 2 substitution itself; roslaunch takes it as text.
        for use in re.finditer(r"\$\((?:find|arg|env|optenv|anon)\s[^()\"'<>$]*(?=[\"'<>]|\$\()", uncommented(source)):
            yield self._at(source, use.span(), f"`{use[0]}` has no closing parenthesis")

    def _tag(self, source: Source, tag: Tag, version: int) -> Findings:
        above = tag.parent
        if above is not None:
            message = _unknown(tag.name, above.name, version)
            if message is not None:
                yield self._at(source, (tag.start + 1, tag.start + 1 + len(tag.name)), message)
                return
        element = ELEMENTS[version].get(tag.name)
        if element is None or above is None:
            return
        attributes = tag.attributes
        misspelt = set[str]()
        for attribute in attributes.values():
            near = _meant(attribute, tag, element.attributes, version)
            if near is not None:
                misspelt.add(near)
                hint = Suggestion(near, attribute.name)
                message = f"unknown attribute `{attribute.name}` of <{tag.name}>" + hint
                place = (attribute.start, attribute.start + len(attribute.name))
                # roslaunch ignores unknown attributes and prints a warning.
                yield self._at(source, place, message, "error" if near else "warning")
        if version == 2 and tag.name == "arg" and above.name != "include" and "value" in attributes:
            value = attributes["value"]
            message = "<arg> has no attribute `value` in ROS 2"
            right = None if "default" in attributes else "default"
            yield self._at(source, (value.start, value.start + 5), message + Suggestion(right, "value"))
        required = list(element.required)
        if tag.name == "arg" and above.name == "include" and "pass_all_args" not in above.attributes:
            required.append("value|default" if version == 1 else "value")
        if tag.name == "node" and version == 2 and _is_in_package(attributes):
            required.append("pkg")
        for names in required:
            if not {*names.split("|")} & {*attributes, *misspelt}:
                message = f"<{tag.name}> lacks the required attribute {' or '.join(f'`{n}`' for n in names.split('|'))}"
                yield self._at(source, (tag.start, tag.end), message)

    def _at(self, source: Source, place: tuple[int, int], message: str, severity: Severity | None = None) -> Finding:
        return self.at_span(source.span(*place), message, severity=severity)


def _unknown(name: str, above: str, version: int) -> str | None:
    """Return the message for an element that its parent cannot contain; None for the others."""
    from urdfkit.lint.facts.launch.python.api import differs_by_a_letter

    table = ELEMENTS[version]
    children = table[above].children if above in table else ()
    is_open = ANY in children
    valid = {*children, *(ACTIONS[version] if is_open else ())}
    if not children or name in valid:
        return None
    near = next((other for other in sorted(valid) if differs_by_a_letter(name, other)), None)
    if near is not None:
        return f"unknown element <{name}> in <{above}>" + Suggestion(f"<{near}>", f"<{name}>")
    if is_open and name in OTHER_ELEMENTS[version]:
        other = OTHER_ELEMENTS[version][name]
        return f"<{name}> is not an action in ROS {version}" + (f"; use <{other}>" if other else "")
    if is_open and version == 2:
        return None
    return f"unknown element <{name}> in <{above}>"


def _meant(attribute: Attribute, tag: Tag, valid: tuple[str, ...], version: int) -> str | None:
    """Return the attribute that an unknown attribute misspells, empty if none is similar; None for valid attributes."""
    name = attribute.name
    if name in (*valid, "if", "unless") or ":" in name or name == "xmlns":
        return None
    other = OTHER_WORDS[version].get(name)
    if other is not None and other in valid and other not in tag.attributes:
        return other
    near = nearest(name, [each for each in (*valid, "if", "unless") if each not in tag.attributes], cutoff=0.6)
    return near if near is not None else "" if version == 1 else None


def _is_in_package(attributes: dict[str, Attribute]) -> bool:
    """Return whether a node in ROS 2 starts an executable of a well-valid package."""
    from urdfkit.lint.facts.launch.executables import released

    program = attributes["exec"].value if "exec" in attributes else ""
    return any(program in found.names for found in released().values())
