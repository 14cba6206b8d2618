"""Commands that write files, killed (SIGKILL) at random moments, on full and read-only disks, with damaged caches.

Run it as ``python tests/bench/kills.py [--count N] [--seed S] [COMMAND]…``. After each interruption, every file must be
the one from before or the complete new one, and none may be missing; the same command is then run again, and the folder
must be exactly what an undisturbed run writes. Half of the kills happen at a random time, half just before a random
operation on a file. Disks are small tmpfs mounts, which need root. Exit status 1 if a run failed.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).parents[2]
Tree = dict[str, bytes | None]
"""Path → content; None for a folder."""

OPERATIONS = {"os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.link", "os.chmod", "os.symlink"}
"""Audit events of changes of the file system; `open` for writing is one more."""

_LINK = (
    '<link name="l{i}"><inertial><mass value="1"/><inertia ixx="9" iyy="9" izz="9" ixy="0" ixz="0" iyz="0"/></inertial>'
)
_BOX = '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>'
_JOINT = '<joint name="j{i}" type="fixed"><parent link="l0"/><child link="l{i}"/></joint>'


def nothing(folder: Path) -> None:
    """Prepare a folder with a file of the user."""
    (folder / "mine").write_text("mine")


def packages(folder: Path) -> None:
    """Prepare packages that an update changes, with an edited file."""
    nothing(folder)
    run(folder, ["new", "robot", "scout", "--sensor", "lidar,camera", "--yes", "-q"])
    (readme,) = folder.glob("scout_description/README.md")
    readme.write_text(readme.read_text() + "edited\n")


def defects(folder: Path) -> None:
    """Prepare files whose defects `lint --fix` fixes."""
    nothing(folder)
    rules = sorted((ROOT / "tests/lint/rules").glob("*/fixed.urdf"))
    for rule in rules[:8]:
        shutil.copy(rule.with_name("bad.urdf"), folder / f"{rule.parent.name}.urdf")


def export(folder: Path) -> None:
    """Prepare a URDF with meshes."""
    nothing(folder)
    facets = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    meshes = ""
    for i in range(4):
        (folder / f"m{i}.stl").write_text(f"solid m\n{facets}endsolid m\n")
        meshes += f'<visual><geometry><mesh filename="m{i}.stl"/></geometry></visual>'
    (folder / "arm.urdf").write_text(f'<robot name="arm"><link name="l0">{meshes}</link></robot>\n')


def bare(folder: Path) -> None:
    """Prepare the packages of a robot without arm, sensors and controllers."""
    nothing(folder)
    run(folder, ["new", "robot", "scout", "--yes", "-q"])


def with_arm(folder: Path) -> None:
    """Prepare the packages of a robot whose arm has no controllers."""
    bare(folder)
    run(folder, ["new", "arm", "--into", "scout_description", "--gripper", "-q"])


def heavy(folder: Path) -> None:
    """Prepare a robot in two files, whose moments of inertia are wrong."""
    nothing(folder)
    xacro = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    parts = [(_LINK + _BOX).format(i=i) + (_JOINT.format(i=i) if i else "") for i in range(6)]
    rest = "\n".join(parts[3:])
    (folder / "rest.xacro").write_text(f"<robot {xacro}>\n{rest}\n</robot>\n")
    text = "\n".join([f'<robot name="r" {xacro}>', *parts[:3], '<xacro:include filename="rest.xacro"/>', "</robot>\n"])
    (folder / "r.urdf.xacro").write_text(text)


COMMANDS: dict[str, tuple[Callable[[Path], None], list[str]]] = {
    "new": (nothing, ["new", "robot", "scout", "--arm", "6", "--sensor", "lidar,camera", "--yes", "-q"]),
    "new --update": (packages, ["new", "robot", "--update", "--arm", "6", "--sensor", "lidar", "--yes", "-q"]),
    "lint --fix": (defects, ["lint", "--fix", "."]),
    "import": (export, ["import", "arm.urdf", "-q"]),
    "new arm": (bare, ["new", "arm", "--into", "scout_description", "--name", "left", "--gripper", "-q"]),
    "new sensor": (bare, ["new", "sensor", "camera", "--into", "scout_description", "--name", "eye", "-q"]),
    "new controllers": (with_arm, ["new", "controllers", "--into", "scout_description", "-q"]),
    "inertia --write": (heavy, ["inertia", "r.urdf.xacro", "--write"]),
}


def run(folder: Path, words: Sequence[str], *, operation: int = 0, seconds: float = 0.0) -> tuple[int, str, int]:
    """Run a command in a child process; return its exit code, its output and the number of its file operations.

    Args:
        folder: the working directory.
        words: the command line.
        operation: kill the process just before this operation on a file; 0: not.
        seconds: kill the process after this time; 0: not.
    """
    with tempfile.TemporaryFile() as output:
        child = os.fork()
        if child == 0:
            _run_here(folder, words, operation, output.fileno())
        if seconds:
            time.sleep(seconds)
            os.kill(child, signal.SIGKILL)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        output.seek(0)
        text, mark, rest = output.read().decode("utf-8", "replace").rpartition("operations: ")
    count, *modules = rest.split() if mark else ["0"]
    for module in modules:  # so that the next child need not
        if module.startswith(("urdfkit.", "numpy.", "trimesh.", "xacro.")):
            with suppress(ImportError):
                import_module(module)
    return code, text if mark else rest, int(count)


def _run_here(folder: Path, words: Sequence[str], operation: int, output: int) -> None:
    count = 0

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        nonlocal count
        if event in OPERATIONS or (event == "open" and int(str(arguments[2] or 0)) & (os.O_WRONLY | os.O_RDWR)):
            count += 1
            if count == operation:
                os.kill(os.getpid(), signal.SIGKILL)

    code = 70
    try:
        os.chdir(folder)
        os.dup2(output, 1)
        os.dup2(output, 2)
        sys.stdout, sys.stderr = (open(number, "w", closefd=False) for number in (1, 2))  # noqa: SIM115
        from urdfkit.cli import main

        sys.addaudithook(hook)
        code = main(list(words))
        made = count
        sys.stdout.flush()
        sys.stderr.write(f"operations: {made} {' '.join(list(sys.modules))}")
        sys.stderr.flush()
    finally:
        os._exit(code)


def tree(folder: Path) -> Tree:
    """Return all files and folders."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
    }


def faults_between(now: Tree, before: Tree, after: Tree) -> Iterator[str]:
    """Yield what an interrupted run has lost, written in part or written elsewhere."""
    now = {
        path: content for path, content in now.items() if not path.startswith(".urdfkit-") and "/.urdfkit-" not in path
    }
    for path, content in now.items():
        if content is not None and content not in (before.get(path), after.get(path)):
            yield f"{path} is half written"
        elif path not in before and path not in after:
            yield f"{path} is neither old nor new"
    yield from (f"{path} is lost" for path in before if path in after and path not in now)


def faults_after(code: int, text: str, now: Tree, after: Tree, wanted: int) -> Iterator[str]:
    """Yield the faults after the same command was run again."""
    different = sorted(path for path in {*now, *after} if now.get(path, 0) != after.get(path, 0))
    if different:
        yield f"next run: {len(different)} paths differ, e.g. {different[0]}: {text[:200]!r}"
    complete = code == 2 and not different and "a bug" not in text  # the killed run was done, or this one completes it
    if (code not in (0, wanted) and not complete) or "Traceback" in text:
        yield f"next run: exit status {code}: {text[-300:]!r}"


def killed(name: str, count: int, chance: random.Random, base: Path) -> tuple[int, list[str]]:
    """Kill `count` runs of a command; return the number of runs that were killed, and the faults."""
    prepare, words = COMMANDS[name]
    (base / "before").mkdir(parents=True)
    prepare(base / "before")
    for folder in (base / "imported", base / "after"):  # the first run also imports modules; the second one is timed
        shutil.copytree(base / "before", folder)
        start = time.perf_counter()
        wanted, text, operations = run(folder, words)
        seconds = time.perf_counter() - start
    before, after = tree(base / "before"), tree(base / "after")
    if before == after or wanted not in (0, 1):
        return 0, [f"the undisturbed run: exit status {wanted}: {text[-300:]!r}"]
    hits, number, faults = 0, -1, []
    while hits < count and number < 3 * count:  # a run that ends before it is killed does not count
        number += 1
        folder = base / str(number)
        shutil.copytree(base / "before", folder)
        if number % 2:
            first = max(operations - 40, 1) if number % 4 == 1 else 1  # the last ones move files into place
            when = {"operation": chance.randint(first, operations)}
            code, text, _ = run(folder, words, operation=when["operation"])
        else:
            when = {"seconds": chance.uniform(0.0, seconds)}
            code, text, _ = run(folder, words, seconds=when["seconds"])
        hits += code == -signal.SIGKILL
        found = list(faults_between(tree(folder), before, after))
        code, text, _ = run(folder, words)
        found += faults_after(code, text, tree(folder), after, wanted)
        faults += [f"{when}: {fault}" for fault in found]
        shutil.rmtree(folder)
    return hits, faults


@contextmanager
def disk(place: Path) -> Iterator[Callable[[str], None]]:
    """Mount a tmpfs; yield a function that changes its options."""
    place.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "none", str(place)], check=True, capture_output=True)

    def change(options: str) -> None:
        subprocess.run(["mount", "-o", f"remount,{options}", str(place)], check=True)

    try:
        yield change
    finally:
        subprocess.run(["umount", str(place)], check=True)


def on_disks(name: str, count: int, chance: random.Random, base: Path) -> tuple[int, list[str]]:
    """Run a command on disks with too little space, and on a read-only disk; return the refusals and faults."""
    prepare, words = COMMANDS[name]
    (base / "before").mkdir(parents=True)
    prepare(base / "before")
    shutil.copytree(base / "before", base / "after")
    wanted, _, _ = run(base / "after", words)
    before, after = tree(base / "before"), tree(base / "after")
    refused, faults = 0, []
    for number in range(count):
        with disk(base / str(number)) as change:
            folder = base / str(number) / "here"
            shutil.copytree(base / "before", folder)
            filler = base / str(number) / "filler"
            free = chance.randrange(0, 60 if name in ("new", "new --update", "import") else 4)
            if number:
                filler.write_bytes(b"x" * (os.statvfs(folder).f_bavail - free) * os.statvfs(folder).f_bsize)
            else:
                change("ro")
            code, text, _ = run(folder, words)
            where = f"{free} pages free" if number else "read-only"
            refused += code == 2
            found = [f"output {text[-300:]!r}"] if "Traceback" in text or "a bug" in text else []
            if code == 2 and not text.splitlines()[-1].startswith("urdfkit: "):
                found.append(f"message {text[-200:]!r}")
            found += faults_between(tree(folder), before, after)
            found += [f"{path} is left" for path in tree(folder) if ".urdfkit-" in path]
            change("rw")
            filler.unlink(missing_ok=True)
            code, text, _ = run(folder, words)
            found += faults_after(code, text, tree(folder), after, wanted)
            faults += [f"{where}: {fault}" for fault in found]
    return refused, faults


def caches(count: int, chance: random.Random, base: Path) -> tuple[int, list[str]]:
    """Lint with damaged caches, and by two processes that share one; return the number of caches and the faults."""
    base.mkdir()
    defects(base)
    words, cache = ["lint", "."], Path(os.environ["URDFKIT_CACHE_DIR"])
    shutil.rmtree(cache, ignore_errors=True)
    _, wanted, _ = run(base, words)
    faults = []
    for number in range(count):
        for path in [path for path in cache.rglob("*") if path.is_file()]:
            content = bytearray(path.read_bytes())
            damage = chance.choice(("cut", "flip", "empty", "folder", "none"))
            if damage == "cut":
                path.write_bytes(content[: chance.randrange(len(content) + 1)])
            elif damage == "flip" and content:
                content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
                path.write_bytes(content)
            elif damage == "empty":
                path.write_bytes(b"")
            elif damage == "folder":
                path.unlink()
                path.mkdir()
        others = []
        if number % 2:
            others = [os.fork()]
            if others[0] == 0:
                code, text, _ = run(base, words)
                os._exit(0 if text == wanted else 1)
        code, text, _ = run(base, words)
        if text != wanted or any(os.waitpid(other, 0)[1] for other in others):
            faults.append(f"cache {number}: exit status {code}: {text[-300:]!r}")
    return count, faults


def main(argv: Sequence[str] | None = None) -> int:
    """Print a table of runs and faults."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200, help="kills of each command (default: 200)")
    parser.add_argument("--disks", type=int, default=20, help="disks for each command (default: 20)")
    parser.add_argument("--caches", type=int, default=40, help="damaged caches (default: 40)")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (default: 1)")
    parser.add_argument("commands", nargs="*", metavar="COMMAND", help=", ".join(COMMANDS))
    arguments = parser.parse_args(argv)
    chance, failed = random.Random(arguments.seed), 0
    with tempfile.TemporaryDirectory() as place:
        base = Path(place).resolve()
        os.environ |= {"URDFKIT_CACHE_DIR": str(base / "cache"), "OPENBLAS_NUM_THREADS": "1"}

        def show(name: str, kind: str, result: tuple[int, list[str]]) -> None:
            nonlocal failed
            count, faults = result
            print(f"{name:16} {kind:14} {count:4} runs  {len(faults):3} faults", *faults[:5], sep="\n    ", flush=True)
            failed += len(faults)

        for number, name in enumerate(arguments.commands or COMMANDS):
            if arguments.count:
                show(name, "killed", killed(name, arguments.count, chance, base / f"{number}k"))
            if arguments.disks and os.geteuid() == 0 and shutil.which("mount"):
                show(name, "disk full", on_disks(name, arguments.disks, chance, base / f"{number}d"))
        if arguments.caches:
            show("lint", "damaged cache", caches(arguments.caches, chance, base / "lint"))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
