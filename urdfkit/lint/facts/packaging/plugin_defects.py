"""Defects of plugins and components: their descriptions, the macros in the code, and the commands that export them.

Sources: pluginlib (class_loader_imp.hpp, pluginlib_export_plugin_description_file.cmake), rclcpp_components
(rclcpp_components_register_node.cmake).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles, is_well_formed
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand, misspelt_word
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.project.code_files import CPP, code_texts
from urdfkit.record import record

_MACRO = r"(?m)^[ \t]*(PLUGINLIB_EXPORT_CLASS|RCLCPP_COMPONENTS_REGISTER_NODE)\s*\(([\w:\s]+?)(?:,([\w:\s]+?))?\)"
_EXPORT = "pluginlib_export_plugin_description_file"
_NODES = ("rclcpp_components_register_node", "rclcpp_components_register_nodes")


@record(eq=False)
class ExportedClass:
    """A class that code exports.

    Attributes:
        kind: name of the macro.
        name: the class.
        base: its base class; empty for components.
        start: offset of the class.
        base_start: offset of the base class.
    """

    source: Source
    path: Path
    kind: str
    name: str
    base: str
    start: int
    base_start: int


def plugin_defects(files: BuildFiles, cmake: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield the defects of plugins and components of a package in C++."""
    listed = [path for path in files.folder.glob("*.xml") if path.name != "package.xml"]
    described = descriptions(files)
    exported = [*_exported(files, every)]
    is_used = described or exported or any(each.name in _NODES for each in every)
    has_macros = is_used or re.search(r"pluginlib|rclcpp_components|nodelet", cmake.text) is not None
    texts = dict(code_texts(files.folder, CPP)) if has_macros else {}
    macros = [macro for path, text in texts.items() for macro in _macros(path, text)]
    accepted = {files.name, *files.dependencies()}
    for command in every:
        if command.name == _EXPORT and len(command.words) == 1:
            message = f"{_EXPORT}() needs the package of the base class and a file"
            yield BuildDefect(cmake, command.start, command.name, message)
        elif command.name == _EXPORT and command.words and "$" not in command.words[0][0]:
            word, start = command.words[0]
            if word not in accepted and not any(word in each.text for each in described):
                near = next((name for name in sorted(accepted) if is_slip(word, name)), None)
                message = f"no dependency has the base class of the package `{word}`" + Suggestion(near, word)
                yield BuildDefect(cmake, start, word, message)
    for place, name in exported:
        path = files.folder / name
        if "$" not in name and not is_file(path) and str(path) not in files.texts:
            near = nearest(name, [each.name for each in listed], cutoff=0.6)
            yield BuildDefect(*place, f"`{name}` does not exist in this package" + Suggestion(near, name))
    names = {name for _, name in exported}
    names |= {each.words[0][0] for each in every if each.name == _EXPORT and len(each.words) == 1}
    if any("$" in name for name in names):
        return
    plugins = [macro for macro in macros if macro.kind.startswith("PLUGINLIB")]
    if (plugins or (described and texts)) and not any("CLASS_LOADER_REGISTER_CLASS" in text for text in texts.values()):
        yield from _classes(described, plugins, texts)
    for source in described:
        name = Path(source.file).name
        yield from _libraries(source, files, every)
        has_slip = any(nearest(name, [each], cutoff=0.6) for each in names if not is_file(files.folder / each))
        if plugins and name not in names and not has_slip and not any("/" in each for each in names):
            if files.build_tool == "catkin":
                tag = next((tag for _, tag in files.tags("export")), files.root)
                if tag is not None:
                    place = (files.manifest, tag.start, f"<{tag.name}")
                    yield BuildDefect(*place, f"package.xml does not export the plugins in `{name}`")
            elif (at := next((each for each in every if each.name == "ament_package"), None)) is not None:
                yield BuildDefect(cmake, at.start, at.name, f"{_EXPORT}() is missing for the plugins in `{name}`")
        elif files.build_tool == "catkin" and name in names and any(each.name == "install" for each in every):
            text = " ".join(word for each in every if each.name == "install" for word, _ in each.words)
            if name not in text and not re.search(r"\$\{(?!PROJECT_NAME|CATKIN_)", text) and "*.xml" not in text:
                at = next(each for each in every if each.name == "install")
                yield BuildDefect(
                    cmake, at.start, at.name, f"`{name}`, which describes plugins, is not installed", "note"
                )
    yield from _components(cmake, every, [each for each in macros if each not in plugins], files, texts)


def descriptions(files: BuildFiles) -> list[Source]:
    """Return the descriptions of plugins in the folder of a package."""
    paths = [path for path in sorted(files.folder.glob("*.xml")) if path.name != "package.xml"]
    return [source for path in paths if (source := _description(path, files)) is not None]


def _description(path: Path, files: BuildFiles) -> Source | None:
    """Return a description of plugins; None for other files."""
    text = files.texts.get(str(path)) or path.read_text("utf-8", "replace")
    source = Source(shown_path(path), text)
    is_description = re.search(r"<(?:library|class_libraries)\b", text) is not None
    return source if is_description and is_well_formed(source) else None


def _exported(files: BuildFiles, every: list[CMakeCommand]) -> Iterator[tuple[tuple[Source, int, str], str]]:
    """Yield place and path of each description that the package exports."""
    for command in every:
        if command.name == _EXPORT and len(command.words) > 1 and files.cmake is not None:
            word, start = command.words[1]
            yield (files.cmake, start, word), word
    for _, export in files.tags("export"):
        for tag in export.children:
            plugin = tag.attributes.get("plugin")
            if plugin is not None and plugin.value.startswith("${prefix}/"):
                place = (files.manifest, plugin.value_start, plugin.value)
                yield place, plugin.value.removeprefix("${prefix}/")


def _macros(path: Path, text: str) -> Iterator[ExportedClass]:
    code = re.sub(r"(?s)/\*.*?\*/|//[^\n]*", lambda comment: re.sub(r"[^\n]", " ", comment[0]), text)
    source = None
    for at in re.finditer(_MACRO, code):
        source = source or Source(shown_path(path), text)
        base = re.sub(r"\s", "", at[3] or "").removeprefix("::")
        name = re.sub(r"\s", "", at[2]).removeprefix("::")
        start, base_start = (at.start(i) + len(at[i] or "") - len((at[i] or "").lstrip()) for i in (2, 3))
        yield ExportedClass(source, path, at[1], name, base, start, base_start)


def _classes(sources: list[Source], macros: list[ExportedClass], texts: dict[Path, str]) -> Iterator[BuildDefect]:
    """Yield classes that differ between descriptions and code."""
    by_name = {macro.name: macro for macro in macros}
    described: set[str] = set()
    entries = [(source, tag) for source in sources for root in Document(source).roots for tag in root.walk()]
    classes = [(source, tag) for source, tag in entries if tag.name == "class"]
    of_code = [each for each in classes if "_py" not in _value(each[1], "base_class_type")]
    types = {_value(tag, "type") for _, tag in of_code}
    for source, tag in of_code:
        for wanted in ("type", "base_class_type"):
            if wanted not in tag.attributes:
                near = nearest(wanted, [name for name in tag.attributes if name not in _ATTRIBUTES], cutoff=0.7)
                at = tag.attributes[near].start if near is not None else tag.start
                message = (
                    f"unknown attribute `{near}`" + Suggestion(wanted, near) if near else f"<class> has no `{wanted}`"
                )
                yield BuildDefect(source, at, near or "<class", message)
        kind, base = _value(tag, "type"), _value(tag, "base_class_type")
        macro = by_name.get(kind)
        if not kind:
            described |= {*by_name}
            continue
        at = tag.attributes["type"].value_start
        last = kind.rpartition(":")[2]
        if macro is None:
            other = next((each for each in macros if is_slip(each.name, kind) and each.name not in types), None)
            is_defined = _is_defined(last, texts)
            if other is not None and is_defined and not _is_defined(other.name.rpartition(":")[2], texts):
                described.add(other.name)
                message = f"no class `{other.name}` is defined" + Suggestion(kind, other.name)
                yield BuildDefect(other.source, other.start, other.name, message)
            elif not by_name and not is_defined:
                continue  # the class may be in another package
            elif other is not None or not is_defined:
                near = other.name if other is not None else nearest(kind, [*by_name], cutoff=0.6)
                described |= {near} if near else set[str]()
                message = f"no code exports the class `{kind}`" + Suggestion(near, kind)
                yield BuildDefect(source, at, kind, message)
            else:
                path = next(path for path, text in texts.items() if re.search(_defining(last), text))
                definition = re.search(_defining(last), texts[path])
                message = f"PLUGINLIB_EXPORT_CLASS is missing for `{kind}`, which `{Path(source.file).name}` describes"
                if definition is not None:
                    code = Source(shown_path(path), texts[path])
                    yield BuildDefect(code, definition.end() - len(last), last, message)
            continue
        described.add(kind)
        if base and macro.base and base != macro.base:
            is_right = re.search(
                rf"\b(?:class|struct)\s+{last}\b[^{{;]*\b{macro.base.rpartition(':')[2]}\b", "\n".join(texts.values())
            )
            message = f"`{base}` is not the base class `{macro.base}` in PLUGINLIB_EXPORT_CLASS"
            if is_right is not None:
                yield BuildDefect(source, tag.attributes["base_class_type"].value_start, base, message)
            else:
                message = f"`{macro.base}` is not the base class `{base}` in `{Path(source.file).name}`"
                yield BuildDefect(macro.source, macro.base_start, macro.base, message)
        name = _value(tag, "name")
        if name and name.rpartition("/")[2] != last and is_slip(name.rpartition("/")[2], last):
            start = tag.attributes["name"].value_start
            yield BuildDefect(source, start, name, f"the name `{name}` misspells the class `{last}`", "warning")
        if "name" not in tag.attributes:
            near = nearest("name", [each for each in tag.attributes if each not in _ATTRIBUTES], cutoff=0.6)
            if near is not None:
                message = f"unknown attribute `{near}`" + Suggestion("name", near)
                yield BuildDefect(source, tag.attributes[near].start, near, message)
    for macro in macros if sources else ():
        if macro.name not in described and not any(is_slip(macro.name, kind) for kind in types):
            message = f"no description of plugins names the class `{macro.name}`"
            yield BuildDefect(macro.source, macro.start, macro.name, message, "warning")


_ATTRIBUTES = ("name", "type", "base_class_type", "description")


def _value(tag: Tag, name: str) -> str:
    attribute = tag.attributes.get(name)
    return attribute.value.strip().removeprefix("::") if attribute is not None else ""


def _defining(name: str) -> str:
    return rf"\b(?:class|struct)\s+(?:[A-Z_]+\s+)?({re.escape(name)})\b(?!\s*;)|\busing\s+({re.escape(name)})\b"


def _is_defined(name: str, texts: dict[Path, str]) -> bool:
    return any(re.search(_defining(name), text) for text in texts.values())


def _libraries(source: Source, files: BuildFiles, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield libraries of a description that CMakeLists.txt does not build."""
    names = [
        re.sub(r"\$\{(?:CMAKE_)?PROJECT_NAME\}", files.name, each.words[0][0])
        for each in every
        if each.name == "add_library" and each.words
    ]
    if (
        not names
        or any("$" in name for name in names)
        or re.search(r"OUTPUT_NAME|\bPREFIX\b", " ".join(word for each in every for word, _ in each.words))
    ):
        return
    for tag in (tag for root in Document(source).roots for tag in root.walk() if tag.name == "library"):
        path = tag.attributes.get("path")
        if path is None:
            near = nearest("path", list(tag.attributes), cutoff=0.6)
            message = (
                f"unknown attribute `{near}`" + Suggestion("path", near or "") if near else "<library> has no `path`"
            )
            at = tag.attributes[near].start if near else tag.start
            yield BuildDefect(source, at, near or "<library", message)
            continue
        last = path.value.strip().rpartition("/")[2].removesuffix(".so")
        if "$" not in last and last not in names and last.removeprefix("lib") not in names:
            near = nearest(last.removeprefix("lib"), names, cutoff=0.5) or (names[0] if len(names) == 1 else None)
            start = path.value_start + path.value.rindex(last)
            yield BuildDefect(source, start, last, f"no command builds the library `{last}`" + Suggestion(near, last))


def _components(
    cmake: Source, every: list[CMakeCommand], macros: list[ExportedClass], files: BuildFiles, texts: dict[Path, str]
) -> Iterator[BuildDefect]:
    """Yield components that differ between CMakeLists.txt and the code."""
    by_name = {macro.name: macro for macro in macros}
    registered: set[str] = set()
    is_open = any(each.name in ("function", "macro", "include", "foreach") for each in every)
    for command in every if not is_open else ():
        if command.name not in _NODES:
            continue
        words = [word for word, _ in command.words]
        if command.name == _NODES[1]:
            named = command.words[1:]
        elif "PLUGIN" in words[:-1]:
            named = command.words[words.index("PLUGIN") + 1 :][:1]
        else:
            if misspelt_word(command) is None:
                yield BuildDefect(cmake, command.start, command.name, f"{command.name}() has no PLUGIN")
            registered |= {*by_name}
            continue
        for word, start in named:
            if "$" in word or word in by_name:
                registered.add(word)
                continue
            last = word.rpartition(":")[2]
            other = next((each for each in macros if is_slip(each.name, word)), None)
            if other is not None and _is_defined(last, texts) and not _is_defined(other.name.rpartition(":")[2], texts):
                registered.add(other.name)
                message = f"no class `{other.name}` is defined" + Suggestion(word, other.name)
                yield BuildDefect(other.source, other.start, other.name, message)
            elif by_name or texts:
                near = other.name if other is not None else nearest(word, [*by_name], cutoff=0.6)
                registered |= {near} if near else set[str]()
                message = f"no code registers the component `{word}`" + Suggestion(near, word)
                if near is None and _is_defined(last, texts):
                    message = f"RCLCPP_COMPONENTS_REGISTER_NODE is missing in the code of `{word}`"
                yield BuildDefect(cmake, start, word, message)
    added = [each for each in every if each.name == "add_library"]
    for command in every if not is_open and macros else ():
        if command.name != _NODES[0] or len(command.words) < 2:
            continue
        words = [word for word, _ in command.words]
        macro = by_name.get(words[words.index("PLUGIN") + 1]) if "PLUGIN" in words[:-1] else None
        owner = next(
            (
                each.words[0][0]
                for each in added
                if macro and any(word.endswith(macro.path.name) for word, _ in each.words)
            ),
            None,
        )
        word, start = command.words[0]
        if owner is not None and word != owner and any(each.words[0][0] == word for each in added):
            message = f"the code of the component `{macro.name}` is in the target `{owner}`" if macro else ""
            yield BuildDefect(cmake, start, word, message + Suggestion(owner, word))
        elif words[-1] in ("EXECUTABLE", "EXECUTOR"):
            yield BuildDefect(cmake, command.words[-1][1], words[-1], f"{words[-1]} has no name")
    for macro in macros if not is_open else ():
        target = next((each for each in added if any(word.endswith(macro.path.name) for word, _ in each.words)), None)
        if macro.name not in registered and target is not None:
            message = f"rclcpp_components_register_node() is missing for the component `{macro.name}`"
            yield BuildDefect(cmake, target.start, target.name, message, "warning")
