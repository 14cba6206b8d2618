"""Runs a page as its reader does, in an empty folder: writes its files, makes its changes, enters its commands.

- A fenced block with a title is a file: the block replaces its content. The text names a folder that does not exist.
- A block ``diff`` with a title changes that file: the lines with a blank or `-` are in it exactly once.
- In a block ``console`` each line after `$` runs in a shell; the lines below it are its output. `…` stands for any
  text, in a line of its own for any lines. An output that begins with ``urdfkit: FILE:LINE:COLUMN:`` is an error (2).
- ``pip install`` installs without dependencies into a folder beside that of the reader, also for later commands.

``python -m tests.docs.course PAGE`` writes the output that its commands have now into the page.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

from tests.processes import running

ROOT = Path(__file__).parents[2]
HOME = "/home/me"
"""Folder of the reader in outputs."""

PAGES = [
    page
    for folder in ("guides", "tutorials")
    for page in sorted((ROOT / "docs" / folder).glob("*.md"))
    if re.search(r"^```\w+ title=", page.read_text(encoding="utf-8"), re.MULTILINE)
]
"""Pages with files of their own."""

SERVES = re.compile(r"urdfkit (view|sim teleop|replay)\b(?!.*--(image|video|html))")
REFUSED = re.compile(r"urdfkit: \S+:\d+:\d+: ")
WAITS = r"^(urdfkit: )?(warning: )?(compiling the |waiting for the graphics driver|the simulation is starting: ).*\n"
VARIES = ((r"[\d,.]+ × real time", "… × real time"), (r"\b\d+(\.\d+)? m?s \(CPU\)", "… (CPU)"), (r"-(?=0\.0+\b)", ""))


class Block(NamedTuple):
    """A fenced block of a page."""

    language: str
    title: str
    text: str


class Step(NamedTuple):
    """A command, the output that the page shows, and the output that it has."""

    command: str
    shown: str
    printed: str


def blocks(page: str) -> Iterator[Block]:
    """Yield the fenced blocks of a page."""
    pattern = r"^```(\w+)(?: title=\"([^\"]+)\")?[^\n]*\n(.*?)^```$"
    for language, title, text in re.findall(pattern, page, re.MULTILINE | re.DOTALL):
        yield Block(language, title, text)


def unnamed_files(page: str) -> list[str]:
    """Return the files of a page that the text before their block does not name: sites without titles hide them."""
    parts = re.split(r"^```(?:\w+)(?: title=\"([^\"]+)\")?[^\n]*\n.*?^```$", page, flags=re.MULTILINE | re.DOTALL)
    return [title for text, title in zip(parts[::2], parts[1::2], strict=False) if title and title not in text]


def commands(block: str) -> Iterator[tuple[str, str]]:
    """Yield each command of a console block and the output below it."""
    for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
        lines = part.splitlines(keepends=True)
        count = next((k for k, line in enumerate(lines, 1) if not line.endswith("\\\n")), len(lines))
        yield "".join(lines[:count]).rstrip("\n"), "".join(lines[count:])


def minutes(page: str) -> tuple[float, float]:
    """Return how long a page takes [min], first with its files copied, then typed.

    200 words are read in a minute and 150 characters typed, a command takes 2 s, and a file or change 15 s to copy. The
    machine time of the courses is up to twice that on two cores.
    """
    words = len(re.sub(r"^```.*?^```$", "", page, flags=re.MULTILINE | re.DOTALL).split())
    files, entered, typed, count = 0, 0, 0, 0
    for block in blocks(page):
        if block.language == "console":
            for command, shown in commands(block.text):
                words, entered, count = words + len(shown.split()), entered + len(command) + 1, count + 1
        elif block.title or block.language == "python":
            files += 1
            lines = (line for line in block.text.splitlines() if block.language != "diff" or line.startswith("+"))
            typed += sum(len(line.strip()) for line in lines)
        else:
            words += len(block.text.split())
    both = words / 200 + entered / 150 + count / 30
    return both + files / 4, both + typed / 150


def run(page: str, folder: Path) -> Iterator[Step]:
    """Run a page in a folder; yield its steps. A command that serves a page runs until the next one of them.

    Raises:
        AssertionError: a change does not match its file, or a command fails.
    """
    with ExitStack() as served:
        for block in blocks(page):
            if block.language == "console":
                for command, shown in commands(block.text):
                    if SERVES.search(command):
                        served.close()
                        printed = serve(command, folder, served)
                    else:
                        printed = output(command, folder, (2,) if REFUSED.match(shown) else (0, 1))
                    yield Step(command, shown, printed)
            elif block.title:
                write(block, page, folder)


def prepare(page: str, folder: Path) -> None:
    """Write the files of a page into a folder, as its reader has them at the end; see `run`."""
    for block in blocks(page):
        if block.language == "console":
            for command, _ in commands(block.text):
                if command.startswith("urdfkit new ") or re.search(r" --(write|fix)\b", command):
                    output(command, folder, (0, 1))
        elif block.title:
            write(block, page, folder)


def write(block: Block, page: str, folder: Path) -> None:
    """Write or change the file of a block."""
    file = folder / block.title
    named = f"folder `{Path(block.title).parent}`" in " ".join(page.split())
    assert named or file.parent.is_dir(), block.title
    file.parent.mkdir(parents=True, exist_ok=True)
    text = _changed(file, block.text) if block.language == "diff" else block.text
    file.write_text(text, encoding="utf-8")


def agrees(shown: str, printed: str) -> bool:
    """Return whether the output that a page shows stands for the output of the command."""
    for pattern, text in VARIES:
        shown, printed = re.sub(pattern, text, shown), re.sub(pattern, text, printed)
    lines = [
        r"(?s:.*?)" if line == "…" else re.escape(line).replace("…", ".*") for line in shown.rstrip("\n").split("\n")
    ]
    return re.fullmatch("\n".join(lines), printed.rstrip("\n")) is not None


def _changed(file: Path, change: str) -> str:
    lines = change.splitlines(keepends=True)
    old = "".join(line[1:] for line in lines if line[0] in " -")
    new = "".join(line[1:] for line in lines if line[0] in " +")
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{file.name} contains these lines {text.count(old)} times:\n{old}"
    return text.replace(old, new)


def _environment(folder: Path) -> dict[str, str]:
    path = f"{ROOT}{os.pathsep}{_site(folder)}"
    own = {"PYTHONPATH": path, "COLUMNS": "100", "XDG_RUNTIME_DIR": str(folder)}
    return {**os.environ, **own, "PYTHONUNBUFFERED": "1"}  # notes and results in the order of a terminal


def _site(folder: Path) -> Path:
    return folder.with_name(folder.name + "-site")


def serve(command: str, folder: Path, served: ExitStack) -> str:
    """Start a command that serves a page, until the end of `served`; return its first line, with the address."""
    words = [sys.executable, "-m", "urdfkit", *shlex.split(command)[1:], "--no-browser", "--port", "0"]
    options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL, "text": True}
    process = served.enter_context(running(words, cwd=folder, env=_environment(folder), **options))
    line = process.stdout.readline()
    assert "http://127.0.0.1:" in line, command
    return line


def output(command: str, folder: Path, statuses: tuple[int, ...] = (0,)) -> str:
    """Run a command in a shell; return what it prints, with `HOME` in place of the folder.

    Raises:
        AssertionError: the exit status is another one.
    """
    python = shlex.quote(sys.executable)
    programs = f'urdfkit() {{ {python} -m urdfkit "$@"; }}; python() {{ {python} "$@"; }}\n'
    install = f"--no-build-isolation --no-deps --upgrade --target {shlex.quote(str(_site(folder)))}"
    programs += f'pip() {{ {python} -m pip "$@" -qq --disable-pip-version-check {install}; }}\n'
    done = subprocess.run(
        ["/bin/bash", "-c", programs + command],
        cwd=folder,
        env=_environment(folder),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode in statuses, f"{command}\n{done.stdout}"
    printed = re.sub(WAITS, "", done.stdout, flags=re.MULTILINE)
    return printed.replace(str(folder), HOME)


def updated(page: str) -> str:
    """Return the page with the output that its commands have now where the page shows another."""
    with tempfile.TemporaryDirectory() as folder:
        for step in run(page, Path(folder).resolve()):
            print(f"$ {step.command}\n{step.printed}", file=sys.stderr)
            if step.shown.strip() and not SERVES.search(step.command) and not agrees(step.shown, step.printed):
                page = page.replace(f"$ {step.command}\n{step.shown}", f"$ {step.command}\n{step.printed}", 1)
    return page


if __name__ == "__main__":
    for name in sys.argv[1:]:
        Path(name).write_text(updated(Path(name).read_text("utf-8")), "utf-8")
