"""Changes to package.xml and CMakeLists.txt of an existing package: one more file, one more dependency."""

import re
from pathlib import Path

from urdfkit.description.packages.related_files import name_in
from urdfkit.scaffold.additions.file_changes import Alteration

_NEEDS = re.compile(r"<(?:build_|exec_|run_|build_export_|test_)?depend\b[^>]*>\s*([\w.-]+)\s*<")
_LAST = re.compile(
    r"(?m)^([ \t]*)<(?:buildtool_|build_|exec_|run_|test_|build_export_)?depend\b.*?</\w+>[^\n]*\n", re.DOTALL
)
_FILES = re.compile(r"(?i:install\s*\(\s*(?:FILES|PROGRAMS))\b([^)]*?)(?:\)|\s[A-Z_]{4,}\s)")
_FILE = re.compile(r'#[^\n]*|"[^"]*"|[^\s"#]+')


def package_of(path: Path) -> Path | None:
    """Return the folder of the package that contains a file; None if no package contains it.

    Args:
        path: the file.
    """
    return next((folder for folder in path.resolve().parents if (folder / "package.xml").is_file()), None)


def needs(package: Path) -> set[str]:
    """Return the dependencies declared in a package's package.xml.

    Args:
        package: folder of the package.
    """
    return set(_NEEDS.findall(_text(package / "package.xml")))


def with_dependency(package: Path, name: str, *, alone: bool = False) -> Alteration | None:
    """Return the change to package.xml that adds a dependency; None if it is declared or the package itself.

    Args:
        package: folder of the package.
        name: the package to depend on.
        alone: whether to ignore dependencies of neighbouring packages, such as ``_gazebo`` next to ``_description``.
    """
    manifests = [package / "package.xml", *([] if alone else sorted(package.parent.glob("*/package.xml")))]
    if any(name in _NEEDS.findall(_text(path)) for path in manifests):
        return None
    path = package / "package.xml"
    before = path.read_bytes()
    text = before.decode("utf-8", "surrogateescape")
    if name_in(text) == name:
        return None
    tag = "run_depend" if not re.search(r"<package[^>]*\bformat\s*=\s*[\"'][23]", text) else "exec_depend"
    places = list(_LAST.finditer(text))
    if not places:
        return None
    last = places[-1]
    newline = "\r\n" if last[0].endswith("\r\n") else "\n"
    after = text[: last.end()] + f"{last[1]}<{tag}>{name}</{tag}>{newline}" + text[last.end() :]
    return Alteration(path, before, after.encode("utf-8", "surrogateescape"))


def with_installed(package: Path, existing: Path, new: Path) -> Alteration | None:
    """Return the change to CMakeLists.txt that installs a new file like an existing one.

    A sorted list stays sorted. None if no change is needed: the folder is installed as a whole, or not at all.

    Args:
        package: folder of the package.
        existing: the existing file, in the same folder.
        new: the new file.
    """
    path = package / "CMakeLists.txt"
    if not path.is_file():
        return None
    before = path.read_bytes()
    text = before.decode("utf-8", "surrogateescape")
    root = package.resolve()
    old_name, new_name = (file.resolve().relative_to(root).as_posix() for file in (existing, new))
    for rule in _FILES.finditer(text):
        listed = [file for file in _FILE.finditer(text, *rule.span(1)) if not file[0].startswith("#")]
        names = [file[0].strip('"') for file in listed]
        if old_name in names and new_name not in names:
            in_order = names == sorted(names)
            later = [file for file, name in zip(listed, names, strict=True) if in_order and name > new_name]
            place = later[0] if later else listed[-1 if in_order else names.index(old_name)]
            newline = "\r\n" if "\r\n" in text else "\n"
            indent = re.search(r"\n([ \t]*)\Z", text[: place.start()])
            between = f"{newline}{indent[1]}" if indent is not None else " "
            put = new_name + between if later else between + new_name
            at = place.start() if later else place.end()
            return Alteration(path, before, f"{text[:at]}{put}{text[at:]}".encode("utf-8", "surrogateescape"))
    return None


def bridge_configurations(package: Path) -> list[Path]:
    """Return the configuration files of ros_gz_bridge in a package and its neighbours.

    Args:
        package: folder of the package.
    """
    found = (path for folder in (package, *sorted(package.parent.glob("*/"))) for path in folder.glob("config/*.yaml"))
    return [path for path in dict.fromkeys(found) if "gz_topic_name:" in _text(path)]


def _text(path: Path) -> str:
    try:
        return re.sub(r"(?s)<!--.*?-->", "", path.read_text(encoding="utf-8", errors="replace"))
    except OSError:
        return ""
