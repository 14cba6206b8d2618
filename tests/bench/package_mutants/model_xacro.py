"""Mistakes in xacro: properties, macros, arguments and expressions."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

from tests.bench.package_mutants.mutant import (
    Mutant,
    Workspace,
    attribute,
    element,
    kind,
    literal,
    match,
    renamed_tag,
    typo,
    value,
    wrong_name,
)

_MODEL = kind("model")
Mutants = Iterator[Mutant]


@_MODEL
def unknown_property(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops: the name is not defined."""
    defined = {literal(tag, "name") for _, tag in ws.tags("/urdf/", "xacro:property")}
    for file, tag in ws.model_tags():
        text = tag._text[tag.start : tag.end]
        for found in re.finditer(r"\$\{([^{}]*)\}", text):
            for word in re.finditer(r"[a-z_]\w{3,}", found[1]):
                if word[0] in defined:
                    start = tag.start + found.start(1) + word.start()
                    wrong = typo(word[0], lot, defined).replace("-", "")
                    yield Mutant(file, start, start + len(word[0]), wrong, (tag.start, tag.end), None, (wrong,))


@_MODEL
def renamed_property(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops where the old name is used."""
    defined = {literal(tag, "name") for _, tag in ws.tags("/urdf/", "xacro:property")}
    for file, tag in ws.tags("/urdf/", "xacro:property"):
        name = literal(tag, "name")
        used = sum(len(re.findall(rf"\b{name}\b", text)) for _, text in ws.of("/urdf/"))
        if name and used > 1:
            yield wrong_name(file, tag, "name", typo(name, lot, defined).replace("-", ""), uses=True)


@_MODEL
def unknown_macro(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro does not expand a macro that does not exist."""
    macros = {f"xacro:{literal(tag, 'name')}" for _, tag in ws.tags("/urdf/", "xacro:macro")}
    for file, tag in ws.model_tags():
        if tag.name in macros:
            mutant = renamed_tag(file, tag, f"xacro:{typo(tag.name[6:], lot, macros)}")
            yield mutant
            if tag.empty:
                yield renamed_tag(file, tag, tag.name[6:])


@_MODEL
def macro_argument(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops: an argument is unknown or missing."""
    macros = {f"xacro:{literal(tag, 'name')}" for _, tag in ws.tags("/urdf/", "xacro:macro")}
    for file, tag in ws.model_tags():
        if tag.name in macros:
            for name in tag.attributes:
                yield attribute(file, tag, name, lot.choice(["", typo(name, lot)]))


@_MODEL
def include_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro does not find the file or the package."""
    for file, tag in ws.tags("/urdf/", "xacro:include"):
        written = tag.attributes["filename"].value
        stem = re.search(r"(\w+)(\.\w+)*\.xacro$", written)
        package = re.search(r"\$\(find (\w+)\)", written)
        if stem is not None:
            yield value(file, tag, "filename", written.replace(stem[1], typo(stem[1], lot)), names=(stem[0],))
        if package is not None:
            wrong = typo(package[1], lot)
            yield value(file, tag, "filename", written.replace(package[1], wrong), names=(wrong,))


@_MODEL
def include_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """Macros, materials or parts of the robot are missing."""
    for file, tag in ws.tags("/urdf/", "xacro:include"):
        included = tag.attributes["filename"].value.rpartition("/")[2]
        inside = [path for path in ws.files if path.endswith(f"/{included}")]
        names = {literal(other, "name") for path in inside for other in ws.document(path).walk()} - {""}
        used = tuple(
            sorted(
                name
                for name in names
                if any(
                    re.search(rf"\b{re.escape(name)}\b", text) for path, text in ws.of("/urdf/") if path not in inside
                )
            )
        )
        if used:
            yield element(file, tag, names=used, uses=True)


@_MODEL
def broken_expression(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops: a bracket or an operator is missing."""
    for file, tag in ws.model_tags():
        text = tag._text[tag.start : tag.end]
        for found in re.finditer(r"\$\{[^{}]*\}", text):
            inner = found[0][2:-1]
            wrong = [f"${{{inner}", f"{{${inner}}}", f"${{{inner}+}}", f"$({inner})", f"${{({inner}}}"]
            start = tag.start + found.start()
            yield Mutant(file, start, start + len(found[0]), lot.choice(wrong), (tag.start, tag.end))


@_MODEL
def unknown_xacro_argument(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops: the argument is not declared."""
    for file, tag in ws.tags("/urdf/"):
        for found in re.finditer(r"\$\(arg (\w+)\)", tag._text[tag.start : tag.end]):
            start = tag.start + found.start(1)
            wrong = typo(found[1], lot)
            yield Mutant(file, start, start + len(found[1]), wrong, (tag.start, tag.end), None, (wrong,))
    for file, tag in ws.tags("/urdf/", "xacro:arg"):
        name = literal(tag, "name")
        yield wrong_name(file, tag, "name", typo(name, lot), uses=True)


@_MODEL
def namespace_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The prefix xacro is not bound."""
    for file, tag in ws.tags("/urdf/", "robot"):
        if "xmlns:xacro" in tag.attributes and "<xacro:" in ws.files[file]:
            yield attribute(file, tag, "xmlns:xacro", "")


@_MODEL
def condition_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops: the value is neither true nor false."""
    for file, text in ws.of("/urdf/"):
        for found in re.finditer(r'<xacro:(?:if|unless) value="([^"]*)"', text):
            yield match(file, found, lot.choice(["yes", "on", "ture"]), 1)


@_MODEL
def block_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """xacro stops: the macro needs a block."""
    macros = {
        f"xacro:{literal(tag, 'name')}" for _, tag in ws.tags("/urdf/", "xacro:macro") if "*" in literal(tag, "params")
    }
    for file, tag in ws.model_tags():
        if tag.name in macros and tag.children:
            yield element(file, tag.children[0])
