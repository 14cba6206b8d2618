"""K991 fragment-not-included."""

import re
from pathlib import Path

from urdfkit.description.packages.kept_files import kept
from urdfkit.description.xml.source import Source
from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_INCLUDED = 2
"""Number of files that the robot includes from the folder of the fragment, at least."""

_INCLUDE = re.compile(r"<xacro:include\s[^>]*?filename\s*=\s*[\"']([^\"']*?)([\w.-]+)[\"']")
_COMPUTED = re.compile(r"[})\"'](?:\.\w+)*\.xacro\b")
"""Matches the name of a file that an expression computes."""

_OTHERS = (".xacro", ".urdf", ".launch", ".py", ".xml", ".yaml", ".yml", "CMakeLists.txt", ".sh", ".in", ".erb", ".em")
"""Suffixes of files that may name a fragment."""

_SPARE = re.compile(r"old|back-?up|bak|test|example|template|unused|deprecated|copy|v\d", re.IGNORECASE)


class FragmentNotIncluded(RobotRule):
    """No file includes a xacro fragment of the package.

    ## What it does
    Checks the xacro files without a robot name, in folders from which the robot includes at least two other files. A
    fragment is reported if no file of the package or of its neighbours names it. Files with names such as ``old`` or
    ``test`` are not checked.

    ## Why is this bad?
    The robot lacks the links, sensors or plugins in the fragment. Often an ``<xacro:include>`` was removed.

    ## Example
    ```diff
     <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:include filename="parts/base.xacro"/>
       <xacro:include filename="parts/wheel.xacro"/>
    +  <xacro:include filename="parts/gazebo.xacro"/>
       <xacro:cart_base/>
     </robot>
    ```

    ## References
    The package of this example has a file ``parts/gazebo.xacro``.
    """

    code = "K991"
    name = "fragment-not-included"
    severity = "note"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each fragment that no file names."""
        included = {Path(file).absolute() for file in model.expanded.sources}
        if model.package is None or model.is_incomplete or len(included) <= _MIN_INCLUDED:
            return
        entry = model.expanded.path.absolute()
        folders = [file.parent for file in included if file != entry]
        model.watch(*_OTHERS)
        candidates = [
            file
            for folder in sorted({each for each in folders if folders.count(each) >= _MIN_INCLUDED})
            if model.package in (folder, *folder.parents)
            for file in sorted(folder.glob("*.xacro"))
            if file not in included and not _SPARE.search(file.name) and _is_fragment(file)
        ]
        texts = _texts(model) if candidates else {}
        if any(_COMPUTED.search(text) for text in texts.values()):
            return
        for file in candidates:
            named = re.compile(rf"(?<![\w-]){re.escape(file.name)}")
            if any(named.search(text) for other, text in texts.items() if other != file):
                continue
            place = _include_of(file.parent, model)
            if place is not None:
                source, start = place
                message = f"no file includes `{file.name}`, which is in the same folder as the file included here"
                help = f"include {file.name}, or remove the file"
                yield self.at(model, source.position(start), message, help=help)


def _is_fragment(file: Path) -> bool:
    """Return whether a file is the description of no robot of its own, but not empty."""
    from urdfkit.lint.project.description_files import text_of

    text = text_of(file)
    root = re.search(r"<robot\b[^>]*>", text)
    return root is not None and re.search(r"\sname\s*=", root[0]) is None and text.count("<") > len(("robot", "/robot"))


def _texts(model: Model) -> dict[Path, str]:
    """Return the texts of the package and its neighbours that may name a fragment."""
    sources = model.expanded.sources.items()
    own = {Path(file).absolute(): _uncommented(source.text) for file, source in sources}
    return {**(_texts_near(model.package) if model.package is not None else {}), **own}


@kept
def _texts_near(package: Path) -> dict[Path, str]:
    from urdfkit.description.packages.related_files import neighbours
    from urdfkit.lint.project.code_files import code_texts

    return {
        path.absolute(): _uncommented(text)
        for folder in neighbours(package).values()
        for path, text in code_texts(folder, _OTHERS)
    }


def _uncommented(text: str) -> str:
    return re.sub(r"(?s)<!--.*?-->", "", text) if "<!--" in text else text


def _include_of(folder: Path, model: Model) -> tuple[Source, int] | None:
    """Return the last include of a file in a folder, and its source."""
    for file, source in model.expanded.sources.items():
        near = Path(file).absolute().parent
        for use in reversed(list(_INCLUDE.finditer(source.text))):
            if (near == folder and not use[1]) or folder.name == use[1].rstrip("/").rpartition("/")[2]:
                return source, use.start()
    return None
