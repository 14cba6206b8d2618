"""Defects of setup.py and setup.cfg of ROS 2 packages in Python: installed files, entry points and their folder."""

import ast
import fnmatch
import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of, parsed
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect


def setup_defects(files: BuildFiles, source: Source, used: dict[str, str]) -> Iterator[BuildDefect]:
    """Yield the defects of setup.py and setup.cfg.

    Args:
        files: the build files of the package.
        source: its setup.py.
        used: path in the package → the place where a launch file uses it; empty for launch files.
    """
    tree = parsed(source)
    if tree is None:
        return
    reader = launch_reader(tree)
    keywords = _keywords(tree)
    yield from _data_files(files, source, reader, keywords.get("data_files"), used)
    scripts = _scripts(source, reader, keywords.get("entry_points"))
    yield from _groups(source, reader, keywords.get("entry_points"))
    yield from _packages(files, source, keywords.get("packages"), scripts)
    if "package_dir" not in keywords:
        for text, start in scripts:
            yield from _entry_point(files, source, text, start)
    yield from _folder(files, source, bool(scripts))


def _keywords(tree: ast.Module) -> dict[str, ast.expr]:
    """Return the arguments of the call of setup()."""
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and name_of(node.func) == "setup"]
    return {word.arg: word.value for word in calls[0].keywords if word.arg} if len(calls) == 1 else {}


def _text(reader: LaunchReader, node: ast.expr) -> str | None:
    """Return the text of a constant, of a sum of constants, or of os.path.join of constants."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = _text(reader, node.left), _text(reader, node.right)
        return None if left is None or right is None else left + right
    if isinstance(node, ast.Call) and name_of(node.func) == "join" and not node.keywords:
        texts = [_text(reader, part) for part in node.args]
        return None if None in texts or not texts else "/".join(text for text in texts if text is not None)
    return reader.text(node)


def _installed(reader: LaunchReader, data: ast.expr) -> list[tuple[str, ast.expr, bool, ast.expr]] | None:
    """Return the paths and patterns in data_files, whether each is one, and its place; None if one is computed."""
    found = []
    if not isinstance(data, ast.List):
        return None
    for pair in data.elts:
        if not isinstance(pair, ast.Tuple) or len(pair.elts) != 2:
            return None
        parts = [pair.elts[1]]
        while parts:
            part = parts.pop(0)
            if isinstance(part, (ast.List, ast.Tuple)):
                parts += part.elts
                continue
            if isinstance(part, ast.BinOp) and isinstance(part.op, ast.Add) and _text(reader, part) is None:
                parts += [part.left, part.right]
                continue
            is_pattern = isinstance(part, ast.Call) and name_of(part.func) in ("glob", "iglob")
            inner = part.args[0] if isinstance(part, ast.Call) and is_pattern and part.args else part
            text = _text(reader, inner)
            if text is None:
                return None
            found.append((text.removeprefix("./"), inner, is_pattern, pair.elts[0]))
    return found


def _data_files(
    files: BuildFiles, source: Source, reader: LaunchReader, data: ast.expr | None, used: dict[str, str]
) -> Iterator[BuildDefect]:
    from urdfkit.description.packages.similar_names import near_path

    installed = _installed(reader, data) if data is not None else None
    if installed is None or data is None:
        return
    misspelt = set()
    for text, node, is_pattern, to in installed:
        start, end = place(source, node)
        folder = text.rpartition("/")[0] if is_pattern else text
        hint = near_path(files.folder / folder) if folder and "*" not in folder and not files.has(folder) else ""
        meant = (_text(reader, to) or "").removeprefix(f"share/{files.name}/").strip("/")
        is_missing = is_pattern and bool(folder) and "*" not in folder and not files.has(folder) and not hint
        if is_missing and meant in map(_folder_of, used):
            hint = f"; launch files use `{meant}`"
        if is_pattern and hint:
            misspelt.add(folder)
            message = f"folder `{folder}` does not exist in this package" + hint
            yield BuildDefect(source, start, source.text[start:end], message, kind="missing")
        elif not is_pattern and not files.has(text):
            message = f"`{text}` does not exist in this package" + hint
            yield BuildDefect(source, start, source.text[start:end], message, kind="missing")
    # Otherwise, the wrong name in setup.py is the cause.
    is_named = re.search(rf"[\"'/]{re.escape(files.name)}[\"'/]", source.text) is not None
    left_out: dict[int, list[tuple[str, str]]] = {}
    ends: dict[int, int] = {}
    elsewhere: dict[tuple[int, int], list[tuple[str, str, list[tuple[ast.expr, ast.expr]]]]] = {}
    for path, use in used.items():
        folder = path.rpartition("/")[0]
        of_folder = [node for text, node, *_ in installed if folder and text.rpartition("/")[0] == folder]
        matching = [(node, to) for text, node, _, to in installed if fnmatch.fnmatch(path, text.replace("**/", "*"))]
        if not of_folder or misspelt or matching:
            if matching and use and is_named:
                elsewhere.setdefault(place(source, matching[0][1]), []).append((path, use, matching))
            continue
        left_out.setdefault(place(source, of_folder[0])[0], []).append((path, use))
        ends[place(source, of_folder[0])[0]] = place(source, of_folder[0])[1]
    for start, paths in left_out.items():
        (path, use), others = paths[0], len(paths) - 1
        more = f" and {others} other file{'s' * (others > 1)} are" if others else " is"
        message = f"`{path}`{more} not installed, but {use}" if use else f"launch file `{path}`{more} not installed"
        yield BuildDefect(source, start, source.text[start : ends[start]], message, "warning")

    for (start, end), uses in elsewhere.items():
        path, use, matching = uses[0]
        share = f"share/{files.name}/{path.rpartition('/')[0]}"
        folders = [_text(reader, to) for _, to in matching]
        if None not in folders and share not in [folder.rstrip("/") for folder in folders if folder is not None]:
            message = f"`{path}` is installed to `{folders[0]}`, but {use} from `{share}`"
            yield BuildDefect(source, start, source.text[start:end], message)


def _folder_of(path: str) -> str:
    return path.rpartition("/")[0]


def _groups(source: Source, reader: LaunchReader, points: ast.expr | None) -> Iterator[BuildDefect]:
    """Yield a misspelt group of entry points, whose executables are not created."""
    from urdfkit.lint.fix_builders import nearest

    keys = [key for key in points.keys if key is not None] if isinstance(points, ast.Dict) else []
    for key in keys:
        name = reader.text(key) or ""
        near = nearest(name, ["console_scripts", "gui_scripts"], cutoff=0.85)
        if near is not None and near != name:
            message = f"unknown group `{name}` of entry points" + Suggestion(near, name)
            yield BuildDefect(source, place(source, key)[0] + 1, name, message)


def _packages(
    files: BuildFiles, source: Source, packages: ast.expr | None, scripts: list[tuple[str, int]]
) -> Iterator[BuildDefect]:
    """Yield an empty list of packages next to console scripts of a module in the package."""
    own = [text for text, _ in scripts if re.search(rf"=\s*{re.escape(files.name)}[.:]", text)]
    if isinstance(packages, ast.List) and not packages.elts and own and files.has(f"{files.name}/__init__.py"):
        start, end = place(source, packages)
        message = f"Python package `{files.name}` is not installed, but `{own[0].partition('=')[0].strip()}` imports it"
        yield BuildDefect(source, start, source.text[start:end], message)


def _scripts(source: Source, reader: LaunchReader, points: ast.expr | None) -> list[tuple[str, int]]:
    """Return the constant console scripts with their offsets."""
    if not isinstance(points, ast.Dict):
        return []
    found = []
    for key, value in zip(points.keys, points.values, strict=True):
        if key is not None and reader.text(key) == "console_scripts" and isinstance(value, (ast.List, ast.Tuple)):
            for node in value.elts:
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found.append((node.value, place(source, node)[0] + 1))
    return found


def _entry_point(files: BuildFiles, source: Source, text: str, start: int) -> Iterator[BuildDefect]:
    """Yield the defect of a console script ``name = module:function``."""
    from urdfkit.lint.fix_builders import meant

    parts = re.fullmatch(r"(\s*[\w.-]+\s*=\s*)([\w.]+)(?:\s*:\s*([\w.]+))?\s*(?:\[.*\])?", text)
    if parts is None or parts[3] is None:
        message = f"`{text}` is not of the form `name = module:function`"
        yield BuildDefect(source, start, text, message)
        return
    top, _, inner = parts[2].partition(".")
    at = start + parts.start(2)
    if not (files.has(top) or files.has(f"{top}.py")):
        near, hint = meant(top, [files.name])
        if near is not None and files.has(near):  # others are modules of other packages
            message = f"module `{top}` does not exist in this package" + hint
            yield BuildDefect(source, at, top, message, kind="missing")
        return
    path = parts[2].replace(".", "/")
    module = next((file for file in (f"{path}.py", f"{path}/__init__.py") if files.has(file)), None)
    if module is None:
        folder = files.folder / path.rpartition("/")[0]
        hint = meant(parts[2].rpartition(".")[2], sorted(file.stem for file in folder.glob("*.py")))[1] if inner else ""
        yield BuildDefect(
            source, at, parts[2], f"module `{parts[2]}` does not exist in this package" + hint, kind="missing"
        )
        return
    defined = _defined(files, module)
    if defined is not None and parts[3].partition(".")[0] not in defined:
        message = f"`{module}` does not define `{parts[3]}`" + meant(parts[3], defined)[1]
        yield BuildDefect(source, start + parts.start(3), parts[3], message)


def _defined(files: BuildFiles, module: str) -> list[str] | None:
    """Return the names that a module defines; None if it may define others."""
    import warnings

    path = files.folder / module
    try:
        text = files.texts.get(str(path)) or (path.read_text("utf-8", "replace") if path.is_file() else None)
        if text is None:
            return None
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text)
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    found: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            found.append(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.append(node.id)
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            if any(alias.name == "*" for alias in node.names):
                return None
            found += [(alias.asname or alias.name).partition(".")[0] for alias in node.names]
        elif isinstance(node, ast.Name) and node.id in ("globals", "setattr"):
            return None
    return found


def _folder(files: BuildFiles, source: Source, has_scripts: bool) -> Iterator[BuildDefect]:
    """Yield a folder of the executables in which ``ros2 run`` does not find them."""
    config = files.config
    if config is not None:
        if has_scripts and not re.search(r"script[-_]dir|install[-_]scripts", source.text):
            yield from _settings(config, files.name)
        for at in re.finditer(
            r"(?m)^\s*(?:script[-_]dir|install[-_]scripts)\s*=\s*\$base/([\w/-]+?)/?\s*$", config.text
        ):
            if at[1] != f"lib/{files.name}":
                message = f"executables are installed to `{at[1]}`, but `ros2 run` searches `lib/{files.name}`"
                yield BuildDefect(config, at.start(1), at[1], message)
        return
    is_elsewhere = re.search(r"script[-_]dir|install[-_]scripts", source.text) or files.has("pyproject.toml")
    if has_scripts and not is_elsewhere:
        message = f"setup.cfg is missing: `ros2 run` finds executables only in `lib/{files.name}`"
        yield BuildDefect(source, source.text.index("console_scripts"), "console_scripts", message)


def _settings(config: Source, name: str) -> Iterator[BuildDefect]:
    """Yield missing or misspelt sections and keys of setup.cfg for the folder of the executables."""
    from urdfkit.lint.facts.ros_packages import is_slip

    words = [(at[1], at.start(1)) for at in re.finditer(r"(?m)^[ \t]*\[?([\w-]+)(?=\s*[\]=])", config.text)]
    found = {word.replace("-", "_"): start for word, start in words}
    for wanted, folder in (("develop", ""), ("script_dir", "develop"), ("install", ""), ("install_scripts", "install")):
        if wanted in found:
            continue
        near = next((word for word in found if is_slip(word, wanted)), None)
        if near is not None:
            message = f"unknown {'key' if folder else 'section'} `{near}`" + Suggestion(wanted, near)
            yield BuildDefect(config, found[near], near, message)
        elif wanted == "install_scripts" or (wanted == "script_dir" and "develop" in found):
            start, text = (found[folder], folder) if folder in found else (0, config.text.partition("\n")[0])
            message = f"setup.cfg does not set `{wanted}=$base/lib/{name}` in [{folder}]"
            yield BuildDefect(config, start, text, message)
            return
    for at in re.finditer(r"(?m)^[ \t]*(?:script[-_]dir|install[-_]scripts)[ \t]*=[ \t]*(\$\w+)/", config.text):
        if at[1] != "$base":
            yield BuildDefect(config, at.start(1), at[1], f"unknown variable `{at[1]}`" + Suggestion("$base", at[1]))
