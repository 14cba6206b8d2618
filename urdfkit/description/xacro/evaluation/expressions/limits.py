"""Limits of evaluation and expansion, far above the sizes of real descriptions, and the exception for files beyond."""

from pathlib import Path

MAX_EXPRESSION = 10_000
"""Characters of one expression; people's have some dozens."""

MAX_EXPRESSIONS = 200_000
"""Expressions evaluated in one run; a robot of 1,200 links has 10,000."""

MAX_DEPTH = 200
"""Levels of brackets and operators of one expression."""

MAX_STEPS = 1_000_000
"""Steps that all expressions of a run may take together; a robot with several arms takes 16,000."""

MAX_CHARACTERS = 100_000
"""Characters of a text that an expression makes."""

MAX_ELEMENTS = 100_000
"""Elements of a list that an expression makes, with those of the lists in it."""

MAX_BITS = 10_000
"""Bits of an integer; a float has 1,024."""

MAX_NESTING = 60
"""Lists in lists."""

MAX_CALLS_DEEP = 60
"""Functions of an expression that call each other."""

MAX_MACRO_CALLS = 10_000
"""Macro calls in one run, against macros that multiply each other; a large robot needs some hundreds."""

MAX_MACRO_DEPTH = 400
"""Macro calls, or blocks, inside one another; stock xacro fails at about 300, with Python's RecursionError."""

MAX_PROPERTY_DEPTH = 400
"""Properties that use one another; stock xacro fails at about 160, with Python's RecursionError."""

MAX_INCLUDE_DEPTH = 60
"""Files that include one another."""

MAX_INCLUDES = 2_000
"""Files read in one run; a file that is read twice counts twice."""

MAX_EXPANDED = 150_000
"""Elements and attributes that macros, blocks and includes of one run make; a robot of 1,200 links has 54,000."""

MAX_YAML = 500_000
"""Bytes of a YAML file that a description loads."""


class TooLarge(Exception):  # noqa: N818 - a fault of the file, diagnosed and reported as such
    """A limit is exceeded; the message is a clause about the element or expression: ``it creates …``."""


def excess(what: str, limit: int, unit: str) -> TooLarge:
    """Return the exception for something that has more than it may."""
    return TooLarge(f"it creates {what} of more than {limit:,} {unit}")


def too_many_steps() -> TooLarge:
    """Return the exception for expressions that take too long."""
    return TooLarge(f"the expressions of this file exceed {MAX_STEPS:,} steps in total")


def check_length(path: str) -> None:
    """Refuse a file that has no end, and YAML that takes too long to read.

    Raises:
        TooLarge: it is no file, or too large.
    """
    file = Path(path)
    if file.exists() and not file.is_file() and not file.is_dir():
        raise TooLarge(f"{path} is not a regular file")
    if file.suffix.lower() in (".yaml", ".yml") and file.is_file() and file.stat().st_size > MAX_YAML:
        raise TooLarge(f"{path} is larger than {MAX_YAML // 1000:,} kB")
