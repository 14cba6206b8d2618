"""Commands of a CMakeLists.txt, with loops over constant words written out."""

import re

from urdfkit.description.xml.source import Source
from urdfkit.record import record


@record(eq=False)
class CMakeCommand:
    """A command of a CMakeLists.txt.

    Attributes:
        name: its name in lower case.
        start: offset of the name.
        words: the arguments with their offsets, without quotes; ``${PROJECT_NAME}`` is not replaced.
    """

    name: str
    start: int
    words: tuple[tuple[str, int], ...]

    @property
    def folders(self) -> tuple[tuple[str, int], ...]:
        """Return the folders of ``install(DIRECTORY …)`` with their offsets; the command itself without any."""
        end = next((at for at, (word, _) in enumerate(self.words) if word in OPTIONS), len(self.words))
        return self.words[1:end] or ((self.name, self.start),)


def commands(source: Source) -> list[CMakeCommand]:
    """Return the commands of a CMakeLists.txt; nested parentheses end a command's arguments.

    Loops over constant words are written out, and variables that are set once to constant words are replaced.
    """
    text = without_comments(source.text)
    found = []
    for at in re.finditer(r"([A-Za-z_]\w*)\s*\(([^()]*)\)", text):
        words = tuple(
            (word[1] if word[1] is not None else word[0], at.start(2) + word.start() + (word[1] is not None))
            for word in re.finditer(r"\"([^\"]*)\"|[^\s\"]+", at[2])
        )
        found.append(CMakeCommand(at[1].lower(), at.start(1), words))
    return _written_out(found, _lists(found)) if "${" in text else found


def without_comments(text: str) -> str:
    """Return the text of a CMakeLists.txt with blanks in place of its comments."""
    return re.sub(_COMMENTS, lambda at: " " * len(at[0]) if at[0].startswith("#") else at[0], text)


_COMMENTS = r"\"(?:\\(?s:.)|[^\"\\])*\"|#\[(=*)\[(?s:.*?)(?:\]\1\]|\Z)|#[^\n]*"
"""Matches comments, and texts in quotes, which can contain a number sign."""

_Words = tuple[tuple[str, int], ...]
_MOST_WORDS = 50
"""Maximum number of words of a variable or a loop that is written out."""


def _lists(found: list[CMakeCommand]) -> dict[str, _Words]:
    """Return name → words of the variables that one ``set()`` sets to constant words."""
    changed = [each.words[0][0] for each in found if each.name in ("set", "option", "foreach") and each.words]
    changed += [each.words[1][0] for each in found if each.name in ("list", "file") and each.words[1:]]
    values = {each.words[0][0]: each.words[1:] for each in found if each.name == "set" and each.words}
    return {
        name: words
        for name, words in values.items()
        if changed.count(name) == 1
        and 0 < len(words) <= _MOST_WORDS
        and not any("$" in word or word in ("CACHE", "PARENT_SCOPE") for word, _ in words)
    }


def _written_out(found: list[CMakeCommand], lists: dict[str, _Words]) -> list[CMakeCommand]:
    """Return the commands with loops and variables replaced; loops that cannot be read are left as they are."""
    result: list[CMakeCommand] = []
    at = 0
    while at < len(found):
        command = found[at]
        items = _items(command, lists) if command.name == "foreach" else None
        end = at if items is None else len(found)
        end = next((i for i in range(at, end) if found[i].name == "endforeach"), end)
        body = found[at + 1 : end]
        if items is None or end == len(found) or any(each.name == "foreach" for each in body):
            result.append(_replaced(command, lists))
            at += 1
            continue
        for item in items:
            result += (_replaced(each, {**lists, command.words[0][0]: (item,)}) for each in body)
        at = end + 1
    return result


def _items(loop: CMakeCommand, lists: dict[str, _Words]) -> _Words | None:
    """Return the words that a ``foreach()`` repeats its commands for; None if they are computed."""
    words = loop.words[1:]
    if [word for word, _ in words[:2]] in (["IN", "LISTS"], ["IN", "ITEMS"]):
        is_list = words[1][0] == "LISTS"
        words = tuple((f"${{{word}}}" if is_list else word, start) for word, start in words[2:])
    words = _replaced(CMakeCommand("", 0, words), lists).words
    is_computed = any("$" in word or word in ("IN", "RANGE") for word, _ in words)
    return None if is_computed or not 0 < len(words) <= _MOST_WORDS else words


def _replaced(command: CMakeCommand, lists: dict[str, _Words]) -> CMakeCommand:
    """Return a command with the words of its variables; the name of a variable in ``set()`` stays."""
    if not any("${" in word for word, _ in command.words):
        return command
    single = {name: each[0][0] for name, each in lists.items() if len(each) == 1}

    def value(use: re.Match[str]) -> str:
        return single.get(use[1], use[0])

    words: list[tuple[str, int]] = []
    for word, start in command.words:
        use = re.fullmatch(r"\$\{(\w+)\}", word)
        replaced = lists.get(use[1], ()) if use is not None else ()
        first = re.match(r"\$\{(\w+)\}", word)
        start = lists[first[1]][0][1] if first is not None and first[1] in single else start
        words += replaced or ((re.sub(r"\$\{(\w+)\}", value, word), start),)
    return CMakeCommand(command.name, command.start, tuple(words))


def misspelt_word(command: CMakeCommand) -> tuple[str, int, str] | None:
    """Return the first keyword of a command that is misspelt: word, offset, suggested word; None without one."""
    from urdfkit.lint.fix_builders import nearest

    is_install = command.name == "install"
    accepted = OPTIONS if is_install else _ARGUMENTS.get(command.name, ())
    if is_install and command.words and command.words[0][0] in ("TARGETS", "TARGET"):
        accepted = (*OPTIONS, *_OF_TARGETS)
    for at, (word, start) in enumerate(command.words if accepted else ()):
        if is_install and at == 0:
            near = nearest(word, MODES, cutoff=0.75) if word.isupper() and word not in MODES else None
        else:
            is_other = not re.fullmatch(r"[A-Z_]+", word) or word in accepted or word in _OTHERS
            near = None if is_other else nearest(word, accepted, cutoff=0.75)
        if near is not None:
            return word, start, near
    return None


MODES = ("CODE", "DIRECTORY", "EXPORT", "FILES", "IMPORTED_RUNTIME_ARTIFACTS", "PROGRAMS", "SCRIPT", "TARGETS")
_OF_TARGETS = (
    *("ARCHIVE", "LIBRARY", "RUNTIME", "OBJECTS", "FRAMEWORK", "BUNDLE", "PUBLIC_HEADER", "PRIVATE_HEADER", "RESOURCE"),
    *("INCLUDES", "EXPORT", "FILE_SET", "NAMELINK_ONLY", "NAMELINK_SKIP", "NAMELINK_COMPONENT", "RUNTIME_DEPENDENCIES"),
)
"""Further arguments of ``install(TARGETS …)``."""

_FILES = ("FILES", "DIRECTORY", "NOINSTALL")
_ARGUMENTS = {
    "find_package": (
        "REQUIRED",
        "COMPONENTS",
        "OPTIONAL_COMPONENTS",
        "QUIET",
        "EXACT",
        "CONFIG",
        "MODULE",
        "NO_MODULE",
    ),
    "catkin_package": ("INCLUDE_DIRS", "LIBRARIES", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS"),
    "add_message_files": _FILES,
    "add_service_files": _FILES,
    "add_action_files": _FILES,
    "generate_messages": ("DEPENDENCIES", "LANGS"),
    "rosidl_generate_interfaces": ("DEPENDENCIES", "LIBRARY_NAME", "SKIP_INSTALL", "ADD_LINTER_TESTS"),
    "catkin_install_python": ("PROGRAMS", "DESTINATION"),
    "rclcpp_components_register_node": ("PLUGIN", "EXECUTABLE", "EXECUTOR", "RESOURCE_INDEX"),
}
"""Command → its arguments in capital letters."""

_OTHERS = ("COMPONENTS", "OPTION")
"""Words that resemble an argument."""

OPTIONS = frozenset(
    (
        *("DESTINATION", "PATTERN", "FILES_MATCHING", "USE_SOURCE_PERMISSIONS", "REGEX", "OPTIONAL", "COMPONENT"),
        *("CONFIGURATIONS", "PERMISSIONS", "DIRECTORY_PERMISSIONS", "FILE_PERMISSIONS", "RENAME", "TYPE"),
        *("MESSAGE_NEVER", "EXCLUDE_FROM_ALL"),
    )
)
