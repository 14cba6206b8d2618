"""Build files of packages: CMakeLists.txt, package.xml, setup.py and setup.cfg with source positions."""

import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

from urdfkit.description.packages.existence import exists, is_folder
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import XmlError
from urdfkit.lint.facts.packaging.cmake_commands import OPTIONS, CMakeCommand, commands, misspelt_word
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import field, record


@record(eq=False)
class BuildFiles:
    """The build files of one package; None for each that is missing.

    Attributes:
        config: setup.cfg.
        texts: absolute path → content that replaces a file on disk, also of files that are not on disk yet.
    """

    folder: Path
    manifest: Source
    cmake: Source | None
    setup: Source | None
    config: Source | None = None
    texts: Mapping[str, str] = field(default_factory=dict, repr=False)

    def has(self, name: str) -> bool:
        """Return whether a path relative to the package is a file or folder."""
        path = str(self.folder / name)
        return exists(path) or path in self.texts or any(other.startswith(f"{path}/") for other in self.texts)

    @cached_property
    def root(self) -> Tag | None:
        """The <package> tag; None if package.xml has none."""
        return next((root for root in Document(self.manifest).roots if root.name == "package"), None)

    def tags(self, *names: str) -> list[tuple[str, Tag]]:
        """Return the text and the tag of each element of package.xml with one of these names."""
        root = self.root
        inner = [tag for tag in root.walk() if tag.name in names] if root is not None else []
        text = self.manifest.text
        return [(text[tag.end : tag.close].strip() if tag.close else "", tag) for tag in inner]

    def dependencies(self) -> set[str]:
        """Return the names in all dependency elements."""
        root = self.root
        names = {tag.name for tag in root.walk() if tag.name.endswith("depend")} if root is not None else set()
        return {text for text, _ in self.tags(*names)}

    @cached_property
    def name(self) -> str:
        """Name of the package."""
        return next((text for text, tag in self.tags("name") if tag.parent is self.root), self.folder.name)

    @property
    def build_tool(self) -> str:
        """Return ``catkin``, ``ament_cmake``, ``ament_python`` or another build tool; empty if none is named."""
        tools = [text for text, _ in self.tags("buildtool_depend")]
        types = [text for text, _ in self.tags("build_type")]
        return next(iter([*types, *tools]), "")


def build_files(model: Model) -> Iterator[BuildFiles]:
    """Yield the build files of the robot's package and of related packages."""
    files = {Path(name).absolute(): source for name, source in model.related_files.items()}
    for path, source in files.items():
        if path.name == "package.xml" and is_well_formed(source):
            cmake, setup, config = (
                files.get(path.with_name(name)) for name in ("CMakeLists.txt", "setup.py", "setup.cfg")
            )
            yield BuildFiles(path.parent, source, cmake, setup, config, model.texts)


def is_well_formed(source: Source) -> bool:
    """Return whether a file can be parsed as XML."""
    try:
        document_of(source)
    except XmlError:
        return False
    return True


def installed_folders(files: BuildFiles) -> tuple[set[str], list[CMakeCommand]] | None:
    """Return the folders that a package installs and the commands that install them; None if they are computed."""
    names: set[str] = set()
    installs: list[CMakeCommand] = []
    if files.cmake is not None:
        every = commands(files.cmake)
        is_loop = any(command.name == "foreach" for command in every)
        if is_loop or re.search(r"\bGLOB\b|ament_auto_package|\binstall_\w+\(", files.cmake.text):
            return None
        for command in every:
            words = [word for word, _ in command.words]
            if misspelt_word(command) is not None:
                return None
            if command.name.startswith("inst") and words[:1] == ["DIRECTORY"]:
                installs.append(command)
                end = next((at for at, word in enumerate(words) if word in OPTIONS), len(words))
                names.update(word.strip("/").partition("/")[0] for word in words[1:end])
            elif command.name == "install":  # A folder among files has its own finding.
                names.update(word.partition("/")[0] for word in words[1:] if "/" in word and "$" not in word)
                names.update(word for word in words[1:] if is_folder(files.folder / word))
    if files.setup is not None:
        names.update(re.findall(r"[\"']([\w-]+)(?:/|[\"'])", files.setup.text))
        if "walk" in files.setup.text or "rglob" in files.setup.text:
            return None
    return None if any("$" in name or name in (".", "") for name in names) else (names, installs)
