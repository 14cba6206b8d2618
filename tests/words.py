"""The words of the project: names and sentences use the terms of the field, each term always the same.

`NAMES` and `PHRASES` list what is not used, with the word to use instead; `MEANT` lists the places where such a word is
the right one, with its reason. Run this file for a list of all places: ``python tests/words.py [PATH ...]``.
"""

from __future__ import annotations

import ast
import io
import re
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]

NAMES = {
    **dict.fromkeys(("mend", "mended", "mending"), "fix, repair"),
    **dict.fromkeys(("tell", "tells", "told", "say", "says", "said", "speak", "speaks"), "report, print, publish"),
    **dict.fromkeys(("wish", "wishes", "ask", "asks", "asked", "asking"), "request, option, requested"),
    **dict.fromkeys(("know", "knows", "known"), "supported, known_<what>"),
    **dict.fromkeys(("anew",), "again"),
    **dict.fromkeys(("thing", "things"), "entity, body, model, object"),
    **dict.fromkeys(("hands", "screws", "tape", "sights", "figures", "likeness"), "a word for its purpose"),
    **dict.fromkeys(
        ("stage", "population", "carry", "loose", "bolted", "given", "remarks", "soundness", "stir"),
        "world, entities, …",
    ),
    **dict.fromkeys(("blamed", "glance", "apart", "caused", "orphans"), "root_cause, features, detached, …"),
    **dict.fromkeys(("planting", "endless", "noting", "guarding", "grafting", "crawling"), "reader, recursion, …"),
    **dict.fromkeys(("remark", "remarks"), "warning, note"),
    **dict.fromkeys(("listener", "listeners"), "subscriber"),
    **dict.fromkeys(("rouse", "whoever", "whose", "somebody"), "wake, …"),
}
"""Part of an identifier → what to use instead."""

PHRASES = {
    r"\bmend(s|ed|ing)?\b": "fix, repair",
    r"\b(tell|tells|told|says|said|speaks?|telling|saying)\b": "report, print, configure with, publish",
    r"\bsay\b": "report, print",
    r"\b(wish|wishes|wished)\b": "request, option",
    r"\b(ask|asks|asked|asking)\b": "request, requested",
    r"\b(look|looks|looked|looking) (at|into|whether|for)\b": "check, inspect, read, search for",
    r"\b(comes?|came) along\b": "bundled",
    r"\b(is|are) none\b": "unknown, missing",
    r"\bwhich is none\b": "unknown",
    r"\bknows? no\b": "unknown ... in ...",
    r"\bnobody\b|\bwhoever\b|\bsomebody\b": "name the subject",
    r"\b(is|are) (not )?there\b": "exists, missing, not found",
    r"\btakes? away\b|\btaken away\b": "remove",
    r"\banew\b": "again, recomputed",
    r"\b(knows?|knew)\b": "supports, accepts",
    r"\b(bolted|loose|soundness|stirs?|rouses?)\b": "fixed base, free body, validation, wake",
    r"\b(blamed?|glances?|orphans?)\b": "root cause, features, parentless links",
    r"\b(planting|endless|noting|guarding|grafting|crawling|likeness)\b": "reader, recursion, similarity, …",
    r"\b(tape|screws|sights)\b": "replay, live parameters, sensor views",
    r"\bleaves? with \d\b": "exit with status",
    r"\b(go|goes|going|went) on\b": "continue",
    r"\bby lot\b": "at random",
    r"\bby hand of\b": "manually",
    r"\bthings?\b": "entity, body, model, object",
    r"\bof one's own\b|\bat home\b": "your own; works with",
    r"\bas fast as it can\b": "faster than real time",
    r"\blisteners?\b": "subscriber",
    r"\bremarks?\b": "warning, note",
    r"\bfeels?\b|\bfelt\b": "state it",
    r"\bwhat (is|was|are|has|have|does|did|nobody|the|it|a|no)\b": "a noun before its pronoun",
    r"\b(those|one|ones) (that|which|who)\b": "a noun before its pronoun",
    r"\bbeside\b": "compared with, next to",
}
"""Phrase in a sentence → what to use instead."""

MEANT = {
    "parse_known_args": "a method of argparse",
    "DIAGONAL_KNOWN": "the ROS constant COVARIANCE_TYPE_DIAGONAL_KNOWN",
    "compiler knows": "the established expression for facts that a compiler can use",
    'name = "loose"': "an option of `urdfkit new world`",
    "CompilationListener": "a listener of numba's compilation events",
    "is None": "the value None",
    "What it does": "a section of the pages of rules",
}
"""Name or text in which such a word is right → the reason."""


DATA = frozenset((".png", ".webp", ".stl", ".dae", ".obj", ".svg", ".json", ".pyc"))
"""Suffixes of files without sentences."""


class Use(NamedTuple):
    """One use of a word that is not ours."""

    path: Path
    line: int
    kind: str
    word: str
    text: str


def words_of(identifier: str) -> list[str]:
    """Return the lower-case words of an identifier in snake_case or CamelCase."""
    return [word.lower() for word in re.findall(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+", identifier)]


def names_in(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield the line and the name of everything that Python code names itself."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.lineno, node.name
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.attr


def sentences_in(source: str, tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield the line and text of every string with a blank in it, and of every comment."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            for number, line in enumerate(node.value.splitlines()):
                yield node.lineno + number, line
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], token.string


def files_below(*places: Path) -> list[Path]:
    """Return the files with names or sentences in some files and folders."""
    return [
        file
        for place in places
        for file in (sorted(place.rglob("*")) if place.is_dir() else [place])
        if file.is_file() and file.suffix not in DATA and "__pycache__" not in file.parts
    ]


def _parsed(text: str) -> ast.AST | None:
    """Return the syntax tree of Python code; None for a template with placeholders."""
    try:
        return ast.parse(text)
    except SyntaxError:
        return None


def uses(path: Path) -> Iterator[Use]:
    """Yield the uses in a file: of Python its names and sentences, else its lines."""
    text = path.read_text(encoding="utf-8")
    tree = _parsed(text) if path.suffix == ".py" else None
    if tree is not None:
        for line, name in names_in(tree):
            for word in words_of(name):
                if word in NAMES and name not in MEANT:
                    yield Use(path, line, "name", word, name)
        sentences = list(sentences_in(text, tree))
    else:
        sentences = list(enumerate(text.splitlines(), 1))
    for line, sentence in sentences:
        prose = re.sub(r"`[^`]*`|\]\([^)]*\)", "`", sentence)  # code and targets of links
        prose = re.sub("|".join(map(re.escape, MEANT)), "", prose)
        for phrase in PHRASES:
            for match in re.finditer(phrase, prose, re.IGNORECASE):
                yield Use(path, line, "prose", match[0].lower(), sentence.strip()[:110])


if __name__ == "__main__":
    paths = [Path(p) for p in sys.argv[1:]] or [ROOT / "urdfkit", ROOT / "docs", ROOT / "README.md"]
    for use in (use for file in files_below(*paths) for use in uses(file)):
        print(f"{use.path}:{use.line}: {use.kind} `{use.word}`: {use.text}")
