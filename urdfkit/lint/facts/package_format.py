"""Defects of a package.xml that its readers refuse (catkin_pkg 1.1, package.py; REP 127, 140 and 149)."""

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.finding import Severity
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.tags import Tag
from urdfkit.record import record

REQUIRED = ("name", "version", "description", "maintainer", "license")
_IN_ALL = (*REQUIRED, "url", "author", "build_depend", "buildtool_depend", "test_depend", "conflict", "replace")
_FROM_2 = ("build_export_depend", "buildtool_export_depend", "depend", "exec_depend", "doc_depend")
_FROM_3 = ("group_depend", "member_of_group")
ELEMENTS = {
    "1": (*_IN_ALL, "export", "run_depend"),
    "2": (*_IN_ALL, "export", *_FROM_2),
    "3": (*_IN_ALL, "export", *_FROM_2, *_FROM_3),
}
"""Format → elements of <package>."""

_EMAIL = r"[-a-zA-Z0-9_%+]+(\.[-a-zA-Z0-9_%+]+)*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}"
_PARTS_OF_DEPEND = frozenset(("build_depend", "build_export_depend", "exec_depend"))
_MAX_MISSING = 2
"""Largest number of missing elements of a package.xml whose package counts as buildable."""


@record(eq=False)
class FormatDefect:
    """A defect at an element of package.xml.

    Attributes:
        is_in_start_tag: whether the start tag alone is the place, not the element.
    """

    tag: Tag
    message: str
    severity: Severity = "error"
    is_in_start_tag: bool = False


def format_defects(files: BuildFiles) -> Iterator[FormatDefect]:
    """Yield the defects; nothing for a file with few of the required elements, which no tool builds."""
    root = files.root
    if root is None:
        return
    found = Counter(tag.name for tag in root.children)
    near_required = {nearest(name, REQUIRED, cutoff=0.8) for name in found}
    missing = [name for name in REQUIRED if name not in found and name not in near_required]
    if len(missing) > _MAX_MISSING:
        return
    for name in missing:
        yield FormatDefect(root, f"package.xml has no <{name}>", is_in_start_tag=True)
    for name in ("name", "version", "description"):
        for tag in [tag for tag in root.children if tag.name == name][1:]:
            yield FormatDefect(tag, f"package.xml has a second <{name}>")
    yield from _elements(root)
    yield from _values(files, root)
    yield from _dependencies(files, root)
    yield from _exports(files)


def _elements(root: Tag) -> Iterator[FormatDefect]:
    """Yield the elements that the format does not have."""
    form = root.attributes["format"].value if "format" in root.attributes else "1"
    if form not in ELEMENTS:
        yield FormatDefect(root, f"unknown format `{form}` of package.xml; use 1, 2 or 3", is_in_start_tag=True)
        return
    later = [tag.name for tag in root.children if tag.name in (*_FROM_2, *_FROM_3)] if form == "1" else []
    if later:
        message = f'<{later[0]}> does not exist in format 1 of package.xml; add `format="3"` to <package>'
        yield FormatDefect(root, message, is_in_start_tag=True)
        return
    for tag in root.children:
        if tag.name in ELEMENTS[form]:
            continue
        if tag.name == "run_depend":
            yield FormatDefect(tag, f"<run_depend> does not exist in format {form}; write <exec_depend>")
            continue
        if tag.name in _FROM_3:
            yield FormatDefect(tag, f"<{tag.name}> does not exist in format {form}")
            continue
        near = nearest(tag.name, ELEMENTS[form], cutoff=0.8)
        advice = Suggestion(near and f"<{near}>", f"<{tag.name}>")
        yield FormatDefect(tag, f"unknown element <{tag.name}> of package.xml" + advice)


def _values(files: BuildFiles, root: Tag) -> Iterator[FormatDefect]:
    """Yield names, versions and addresses that are not of the required form."""
    for text, tag in files.tags("version"):
        if tag.parent is root and not re.fullmatch(r"\d+\.\d+\.\d+", text):
            yield FormatDefect(tag, f"version `{text}` is not of the form 1.2.3")
    for text, tag in files.tags("name"):
        if tag.parent is not root or re.fullmatch(r"[a-z][a-z0-9_-]*", text):
            continue
        if re.fullmatch(r"[a-zA-Z0-9][a-zA-Z0-9_-]*", text):
            message = f"package name `{text}` does not begin with a letter"
            if not text[0].isdigit():
                message = f"package name `{text}` has capital letters; names of packages are lower case"
            yield FormatDefect(tag, message, "warning" if text[0].isdigit() else "note")
        else:
            yield FormatDefect(
                tag, f"package name `{text}` contains characters other than letters, digits, `_` and `-`"
            )
    for text, tag in files.tags("license", "description"):
        if tag.parent is root and not text and not tag.children:
            yield FormatDefect(tag, f"<{tag.name}> is empty")
    for _, tag in files.tags("maintainer", "author"):
        email = tag.attributes.get("email")
        if tag.parent is not root or (email is None and tag.name == "author"):
            continue
        if email is None:
            yield FormatDefect(tag, "<maintainer> has no `email`")
        elif not re.fullmatch(_EMAIL, email.value):
            yield FormatDefect(tag, f"`{email.value}` is not an e-mail address")


def _dependencies(files: BuildFiles, root: Tag) -> Iterator[FormatDefect]:
    """Yield dependencies on the package itself, and dependencies that <depend> includes."""
    dependencies = [(text, tag) for text, tag in files.tags(*ELEMENTS["1"], *ELEMENTS["3"]) if _is_dependency(tag)]
    whole = {text for text, tag in dependencies if tag.name == "depend" and not tag.attributes}
    for text, tag in dependencies:
        if tag.parent is not root:
            continue
        if text == files.name and tag.name != "group_depend":
            yield FormatDefect(tag, f"package `{text}` depends on itself")
        elif text in whole and tag.name in _PARTS_OF_DEPEND and not tag.attributes:
            yield FormatDefect(tag, f"<{tag.name}> repeats <depend>{text}</depend>; remove one of them")


def _is_dependency(tag: Tag) -> bool:
    return tag.name.endswith("depend")


_GAZEBO_PATHS = ("gazebo_model_path", "gazebo_media_path", "plugin_path")


def _exports(files: BuildFiles) -> Iterator[FormatDefect]:
    """Yield paths for Gazebo in ``<gazebo_ros>`` that name no folder of the package, and misspelt attributes."""
    for _, tag in files.tags("gazebo_ros") if files.cmake is not None or files.setup is not None else ():
        for name, attribute in tag.attributes.items():
            if name not in _GAZEBO_PATHS:
                near = nearest(name, _GAZEBO_PATHS, cutoff=0.8)
                if near is not None:
                    yield FormatDefect(tag, f"unknown attribute `{name}` of <gazebo_ros>" + Suggestion(near), "warning")
                continue
            for path in attribute.value.split(":") if name != "plugin_path" else ():
                inner = re.fullmatch(r"\$\{prefix\}/([\w-]+)(?:/.*)?", path)
                build = files.cmake or files.setup
                folder = rf"[\"'/]{re.escape(inner[1])}(?![\w-])" if inner is not None else ""
                is_installed = build is not None and re.search(folder, build.text) is not None
                if inner is not None and not is_installed and not files.has(inner[1]):
                    message = f"folder `{inner[1]}` of {name} does not exist in this package"
                    yield FormatDefect(tag, message, "warning")
