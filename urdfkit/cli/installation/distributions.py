"""The installed distributions that urdfkit requires, directly or indirectly, by the metadata of packages."""

import re
from importlib.metadata import Distribution, PackageNotFoundError, distribution

_NAME = r"[A-Za-z0-9][\w.-]*"
_CLASSIFIER = "License :: "

_SPDX = {
    "MIT License": "MIT",
    "Apache Software License": "Apache-2.0",
    "Apache 2.0": "Apache-2.0",
    "ISC License (ISCL)": "ISC",
    "Python Software Foundation License": "PSF-2.0",
}
"""Licence as packages name it → its SPDX identifier, where that is certain; `BSD License` has two or three clauses."""

BY_LICENCE_FILE = {
    "apsw": "Zlib OR any-OSI",
    "cmeel-qhull": "Qhull",
    "cyclonedds": "EPL-2.0 OR BSD-3-Clause",
    **dict.fromkeys(("locket", "numba"), "BSD-2-Clause"),
    **dict.fromkeys(
        ("colorama", "contourpy", "cycler", "ipython-pygments-lexers", "jinja2", "kiwisolver"), "BSD-3-Clause"
    ),
    **dict.fromkeys(("lz4", "mpmath", "partd", "prompt-toolkit", "pycollada", "scipy", "sympy"), "BSD-3-Clause"),
    **dict.fromkeys(("traitlets", "xacro", "zict"), "BSD-3-Clause"),
}
"""Distribution whose metadata name no SPDX identifier → that of its licence file, which its wheel contains."""

_VAGUE = r"any-OSI|OSI Approved|unknown|BSD(?: License)?|Copyright\b.*|"
"""Matches texts that name no licence."""


def required(name: str = "urdfkit") -> list[Distribution]:
    """Return the installed distributions that a distribution requires with any of its extras, and itself first.

    Requirements that are not installed, such as those of an extra that is not used, are ignored.

    Args:
        name: the distribution; an empty list if it is not installed, as in a checkout on ``PYTHONPATH``.
    """
    found: dict[str, Distribution] = {}
    pending = [(name, True)]
    while pending:
        each, with_extras = pending.pop()
        key = _normalized(each)
        if key in found:
            continue
        try:
            package = found[key] = distribution(each)
        except PackageNotFoundError:
            continue
        for line in package.requires or ():
            wanted = re.match(_NAME, line)
            if wanted is not None and (with_extras or "extra ==" not in line) and not _is_for_tests(line):
                pending.append((wanted[0], False))
    own = found.pop(name, None)
    rest = sorted(found.values(), key=lambda each: each.metadata["Name"].lower())
    return [own, *rest] if own is not None else rest


def _normalized(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _is_for_tests(requirement: str) -> bool:
    return re.search(r"extra == [\"'](?:test|bench|docs)[\"']", requirement) is not None


def licence(package: Distribution) -> str:
    """Return the licence of a distribution: its SPDX expression, else classifiers, else the first line of its text.

    Where these name no licence, the installed file with the licence is added.
    """
    text = _licence_of_metadata(package)
    if re.fullmatch(_VAGUE, text) is None:
        return text
    file = next((each for each in package.files or () if re.match("LICEN[CS]E|COPYING", each.name)), None)
    return f"{text or 'unknown'}; see {file}" if file is not None else text or "unknown"


def _licence_of_metadata(package: Distribution) -> str:
    metadata = package.metadata
    if expression := spdx_expression(package):
        return expression
    classifiers = [str(each) for each in metadata.get_all("Classifier") or () if str(each).startswith(_CLASSIFIER)]
    names = [each.rpartition(" :: ")[2] for each in classifiers]
    if names := [_SPDX.get(each, each) for each in names if each != "OSI Approved"]:
        return ", ".join(names)
    text = str(metadata["License"]).strip() if "License" in metadata else ""
    first = text.splitlines()[0][:80] if text else ""
    return _SPDX.get(first, first)


def spdx_expression(package: Distribution) -> str:
    """Return the licence of a distribution as an SPDX expression; empty if neither metadata nor its file are known."""
    if "License-Expression" in package.metadata:
        return str(package.metadata["License-Expression"])
    return BY_LICENCE_FILE.get(_normalized(package.metadata["Name"]), "")
