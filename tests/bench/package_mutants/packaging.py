"""Mistakes in package.xml, CMakeLists.txt, setup.py and setup.cfg, and files that are renamed or missing."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

from tests.bench.package_mutants.mutant import (
    Mutant,
    Workspace,
    attribute,
    content,
    element,
    kind,
    match,
    renamed_tag,
    text_of,
    typo,
)
from urdfkit.lint.model.tags import Tag

_PACKAGE = kind("package")
_XML = r"/package\.xml$"
_CMAKE = r"/CMakeLists\.txt$"
Mutants = Iterator[Mutant]


def _depends(ws: Workspace) -> Iterator[tuple[str, Tag, str]]:
    for file, tag in ws.tags(_XML):
        if tag.name.endswith("depend"):
            yield file, tag, text_of(tag)


def _used(ws: Workspace, file: str, package: str) -> bool:
    """Return whether launch files, models or meshes of a package name another package."""
    folder = file.split("/")[0]
    if package == "xacro":
        return any(re.search(r"\bxacro\b", text) for path, text in ws.of(rf"^{folder}/launch/"))
    return any(
        re.search(rf"\b{package}\b", text)
        for path, text in ws.files.items()
        if path.startswith(f"{folder}/") and re.search(r"/(launch|urdf|config|scripts)/", path)
    )


@_PACKAGE
def dependency_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """rosdep does not find the package, and the build stops."""
    for file, tag, name in _depends(ws):
        wrong = typo(name, lot)
        yield content(file, tag, wrong, names=(wrong, name))


@_PACKAGE
def dependency_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The package is not installed on another machine."""
    for file, tag, name in _depends(ws):
        if tag.name == "exec_depend" and _used(ws, file, name):
            yield element(file, tag, names=(name,), anywhere=True)


@_PACKAGE
def package_renamed(ws: Workspace, lot: random.Random) -> Mutants:
    """The package has another name than in its CMakeLists.txt and in the launch files."""
    for file, tag in ws.tags(_XML, "name"):
        name = text_of(tag)
        for wrong in (typo(name, lot), f"my_{name}"):
            yield content(file, tag, wrong, names=(wrong, name), uses=True)


@_PACKAGE
def illegal_name(ws: Workspace, lot: random.Random) -> Mutants:
    """Names of packages are lower case letters, digits and underscores."""
    for file, tag in ws.tags(_XML, "name"):
        name = text_of(tag)
        wrong = lot.choice([name.replace("_", " "), name.title(), f"1{name}"])
        yield content(file, tag, wrong, names=(wrong, name), uses=True)


@_PACKAGE
def malformed_version(ws: Workspace, lot: random.Random) -> Mutants:
    """A version is three numbers: the build stops."""
    for file, tag in ws.tags(_XML, "version"):
        yield content(file, tag, lot.choice(["1.0", "v0.1.0", "0.1.0-beta", ""]))


@_PACKAGE
def required_tag_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The build stops: package.xml needs the tag."""
    for file, tag in ws.tags(_XML, "name", "version", "description", "maintainer", "license"):
        yield element(file, tag, names=(tag.name,))


@_PACKAGE
def maintainer_without_email(ws: Workspace, lot: random.Random) -> Mutants:
    """The build stops: a maintainer needs an e-mail address."""
    for file, tag in ws.tags(_XML, "maintainer"):
        yield attribute(file, tag, "email", "")


@_PACKAGE
def tag_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The build stops: the tag is unknown."""
    for file, tag in ws.tags(_XML):
        if tag.name.endswith("_depend"):
            yield renamed_tag(file, tag, lot.choice([f"{tag.name}s", typo(tag.name, lot), "dependency"]))


@_PACKAGE
def tag_of_other_format(ws: Workspace, lot: random.Random) -> Mutants:
    """The build stops: the tag does not exist in this format."""
    for file, tag in ws.tags(_XML):
        if tag.name == "exec_depend":
            yield renamed_tag(file, tag, "run_depend")
    for file, tag in ws.tags(_XML, "package"):
        yield attribute(file, tag, "format", "")


@_PACKAGE
def build_type(ws: Workspace, lot: random.Random) -> Mutants:
    """colcon does not build the package, or as another kind."""
    for file, tag in ws.tags(_XML, "build_type"):
        wrong = typo(text_of(tag), lot)
        yield content(file, tag, wrong, names=(wrong,))
        yield element(file, tag, names=("build_type",), anywhere=True)
        other = "ament_python" if text_of(tag) == "ament_cmake" else "ament_cmake"
        yield content(file, tag, other, names=(other,))


@_PACKAGE
def buildtool_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The build tool that CMakeLists.txt finds is no dependency."""
    for file, tag in ws.tags(_XML, "buildtool_depend"):
        yield element(file, tag, names=(text_of(tag),), anywhere=True, uses=True)


@_PACKAGE
def no_xml(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is no XML."""
    for file, tag in ws.tags(_XML):
        if tag.close is not None and tag.name != "package":
            end = len(ws.files[file])
            yield Mutant(file, tag.close, tag.close_end, "", (tag.start, tag.end), (tag.start, end))
            if not tag.children:
                yield content(file, tag, f"{text_of(tag)} & more")


@_PACKAGE
def duplicated_dependency(ws: Workspace, lot: random.Random) -> Mutants:
    """The package depends on itself, which no build tool can order."""
    for file, tag, name in _depends(ws):
        if name in ws.packages:
            own = file.split("/")[0]
            yield content(file, tag, own, names=(own,))


@_PACKAGE
def folder_not_installed(ws: Workspace, lot: random.Random) -> Mutants:
    """An installed package lacks the folder that launch files or meshes use."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"DIRECTORY ((?:\w+ ?)+)", text):
            for folder in found[1].split():
                if folder in ("hooks", "test"):
                    continue
                start = text.index(folder, found.start(1))
                rest = found[1].split()
                if len(rest) > 1:
                    new = " ".join(each for each in rest if each != folder)
                    yield match(file, found, f"DIRECTORY {new}", names=(folder, f"{folder}/"), anywhere=True)
                else:
                    line = text.rfind("\n", 0, start) + 1
                    end = text.find("\n", start) + 1
                    if text[line:].startswith("install("):
                        yield Mutant(file, line, end, "", names=(folder, f"{folder}/"), anywhere=True)


@_PACKAGE
def install_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """Nothing is installed."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"(?ms)^(?:install|catkin_install_python)\(.*?\)\n", text):
            named = tuple(
                word
                for word in re.findall(r"[\w.]+", found[0])
                if word in ("launch", "config", "urdf", "wait_for_arm.py")
            )
            yield match(file, found, "", names=named, anywhere=True)


@_PACKAGE
def installed_name_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """CMake stops: the folder or the program does not exist."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"DIRECTORY ((?:\w+ ?)+)|PROGRAMS (\S+)", text):
            group = 1 if found[1] else 2
            names = re.findall(r"\w+", found[group])
            name = lot.choice(names) if group == 1 else names[1]
            start = found.start(group) + found[group].index(name)
            wrong = typo(name, lot)
            yield Mutant(file, start, start + len(name), wrong, None, (found.start(), found.end()), (wrong, name))


@_PACKAGE
def wrong_destination(ws: Workspace, lot: random.Random) -> Mutants:
    """The files are installed in another place."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"DESTINATION (\S+?)\)?\n", text):
            catkin = "CATKIN" in found[1]
            wrong = (
                ["${CATKIN_PACKAGE_SHARE}", "${CATKIN_PACKAGE_SHARE_DESTINATON}"]
                if catkin
                else ["share", "share/${PROJECT}"]
            )
            wrong.append("lib/${PROJECT_NAME}" if not catkin else "${PROJECT_SHARE_DESTINATION}")
            new = lot.choice(wrong)
            named = tuple(re.findall(r"\w+", new))
            yield match(file, found, new, 1, around=(text.rfind("install", 0, found.start()), found.end()), names=named)


@_PACKAGE
def package_call_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The package is not registered."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"(?m)^(ament_package|catkin_package)\(\)\n", text):
            yield match(file, found, "", names=(found[1],), anywhere=True)


@_PACKAGE
def find_package_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """CMake stops: the package is not found."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"(?m)^find_package\((\w+) REQUIRED", text):
            wrong = typo(found[1], lot).replace("-", "")
            yield match(file, found, wrong, 1, names=(wrong, found[1]))
            if found[1] in ("ament_cmake", "catkin"):
                end = text.find("\n", found.end()) + 1
                yield Mutant(
                    file,
                    found.start(),
                    end,
                    "",
                    names=(found[1], f"{found[1]}_package", "ament_package"),
                    anywhere=True,
                )


@_PACKAGE
def project_renamed(ws: Workspace, lot: random.Random) -> Mutants:
    """The project has another name than the package, so its files are installed elsewhere."""
    for file, text in ws.of(_CMAKE):
        found = re.search(r"(?m)^project\((\w+)", text)
        assert found is not None
        wrong = typo(found[1], lot)
        yield match(file, found, wrong, 1, names=(wrong, found[1]))


@_PACKAGE
def cmake_syntax(ws: Workspace, lot: random.Random) -> Mutants:
    """CMake stops: a bracket is missing, or the command is unknown."""
    for file, text in ws.of(_CMAKE):
        for found in re.finditer(r"(?m)^(install|find_package|project|ament_package|catkin_package)\(", text):
            end = text.find(")", found.end())
            yield Mutant(file, end, end + 1, "", (found.start(), end), (found.start(), len(text)))
            wrong = typo(found[1], lot).replace("-", "")
            yield match(file, found, wrong, 1, names=(wrong, found[1]), around=(found.start(), end))


@_PACKAGE
def project_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """CMake stops, or the package has no name."""
    for file, text in ws.of(_CMAKE):
        found = re.search(r"(?m)^project\((\w+).*\n", text)
        assert found is not None
        yield match(file, found, "", names=(found[1], "project"), anywhere=True)


@_PACKAGE
def setup_data_files(ws: Workspace, lot: random.Random) -> Mutants:
    """Launch files, settings or package.xml are not installed."""
    for file, text in ws.of(r"/setup\.py$"):
        for found in re.finditer(r"(?m)^ {8}\(.*(package\.xml|resource/|launch/\*|config/\*\.yaml).*\),\n", text):
            word = re.split(r"[/.]", found[1])[0]
            yield match(file, found, "", names=(word, found[1], "resource_index"), anywhere=True)
        for found in re.finditer(r'glob\("(launch|config)/', text):
            wrong = typo(found[1], lot)
            yield match(file, found, wrong, 1, names=(wrong, found[1]))
        for found in re.finditer(r'glob\("config/\*(\.yaml)"\)', text):
            yield match(file, found, ".yml", 1, names=("config", "gofer_controllers.yaml"))


@_PACKAGE
def setup_names(ws: Workspace, lot: random.Random) -> Mutants:
    """The package or its program is installed under another name."""
    for file, text in ws.of(r"/setup\.py$"):
        found = re.search(r'package_name = "(\w+)"', text)
        assert found is not None
        wrong = typo(found[1], lot)
        yield match(file, found, wrong, 1, names=(wrong, found[1]))
        for found in re.finditer(r'"(joint_check) = (\w+)\.(joint_check):(main)"', text):
            for group in (1, 2, 3, 4):
                wrong = typo(found[group], lot).replace("-", "")
                used = group == 1
                yield match(file, found, wrong, group, names=(wrong, found[group]), uses=used)
    for file, text in ws.of(r"/setup\.cfg$"):
        for found in re.finditer(r"\$base/lib/(\w+)", text):
            wrong = typo(found[1], lot)
            yield match(file, found, wrong, 1, names=(wrong,))


def _referenced(ws: Workspace) -> Iterator[tuple[str, str]]:
    """Yield the files that another file names, and their names; names that two files share are ignored."""
    names = [file.rpartition("/")[2] for file in ws.files]
    for file in ws.files:
        name = file.rpartition("/")[2]
        if names.count(name) > 1 or not re.search(r"/(launch|urdf|config|worlds|rviz|scripts)/", file):
            continue
        word = re.compile(rf'["/]{re.escape(name)}["\'<) ]|"{re.escape(name)}"')
        if any(
            other != file
            and re.search(r"/(launch|urdf|CMakeLists)", other)
            and word.search(re.sub(r"(?s)<!--.*?-->", "", text))
            for other, text in ws.files.items()
        ):
            yield file, name


@_PACKAGE
def file_renamed(ws: Workspace, lot: random.Random) -> Mutants:
    """A file has another name than where it is used."""
    for file, name in _referenced(ws):
        stem, dot, rest = name.partition(".")
        wrong = lot.choice([typo(stem, lot), f"{stem}_new", f"my_{stem}"]) + dot + rest
        yield Mutant(file, text=f"{file.rpartition('/')[0]}/{wrong}", action="rename", names=(name,), uses=True)


@_PACKAGE
def file_deleted(ws: Workspace, lot: random.Random) -> Mutants:
    """A file that is used does not exist."""
    for file, name in _referenced(ws):
        yield Mutant(file, action="delete", names=(name,), uses=True)
    for file in ws.files:
        name = file.rpartition("/")[2]
        if name in ("setup.py", "setup.cfg") or "/resource/" in file:
            package = file.split("/")[0]
            yield Mutant(file, action="delete", names=(name, f"resource/{package}"), anywhere=True, uses=True)
