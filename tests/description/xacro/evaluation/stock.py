"""Results of stock xacro and of the evaluator: printed text, files, warnings or error."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import xacro
from xacro import substitution_args

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.evaluation.evaluator import Evaluator
from urdfkit.errors import UrdfkitError


class Result(NamedTuple):
    """The result of one expansion; `text` is None where it fails."""

    text: str | None
    files: list[str]
    warnings: list[str]
    error: str = ""


def by_stock_xacro(path: str | Path, arguments: Mapping[str, str], packages: Packages) -> Result:
    """Return the result of stock xacro; packages are found by urdfkit, as ROS is not installed."""

    def find(name: str) -> str:
        return str(packages.find(name))

    printed = io.StringIO()
    saved = substitution_args._eval_find, substitution_args._eval_dict["find"]
    substitution_args._eval_find = substitution_args._eval_dict["find"] = find
    xacro._global_symbols = xacro.create_global_symbols()
    xacro.all_includes = []
    try:
        with contextlib.redirect_stderr(printed):
            text = str(xacro.process_file(str(path), mappings=dict(arguments)).toprettyxml(indent="  "))
    except Exception as error:
        return Result(None, [], [], f"{type(error).__name__}: {error}")
    finally:
        substitution_args._eval_find, substitution_args._eval_dict["find"] = saved
    warnings = [line for line in printed.getvalue().splitlines() if line.startswith("warning: ")]
    files = dict.fromkeys(os.path.normpath(Path(name).absolute()) for name in [path, *xacro.all_includes])
    return Result(text, list(files), warnings)


def by_urdfkit(path: str | Path, arguments: Mapping[str, str], packages: Packages) -> Result:
    """Return the result of the evaluator."""
    try:
        expanded = Evaluator(str(path), arguments, packages).expand()
        text = expanded.xml
    except UrdfkitError as error:
        return Result(None, [], [], str(error))
    warned = [warning.message.split("\n")[0] for warning in expanded.warnings if warning.level == "warning"]
    return Result(text, [str(file) for file in expanded.files], [f"warning: {line}" for line in warned])


def difference(path: str | Path, arguments: Mapping[str, str], packages: Packages) -> tuple[str, Result]:
    """Return in what both differ (an empty text if in nothing), and the result of stock xacro."""
    stock = by_stock_xacro(path, arguments, packages)
    ours = by_urdfkit(path, arguments, packages)
    if (stock.text is None) != (ours.text is None):
        if stock.error.startswith("AttributeError: ") and stock.error.endswith("'replace'"):
            return "", stock  # <xacro:attribute> with a value that is not a string: stock xacro cannot print it
        missing = stock.error.rpartition("No such file or directory: ")[2].strip("'")
        if packages.relocate(missing) is not None:
            return "", stock  # a file that only its installation puts in place
        return f"stock xacro: {stock.error or 'expands it'}; urdfkit: {ours.error or 'expands it'}", stock
    for name in ("text", "files", "warnings"):
        if getattr(stock, name) != getattr(ours, name):
            return f"{name}: {getattr(stock, name)} != {getattr(ours, name)}", stock
    return "", stock
