"""Broken files by the thousand: the linter reports each defect, or refuses the file.

Run it as ``python tests/bench/fuzz_lint.py [COUNT] [SEED] [FOLDER]``. It takes the robots we ship (and the files of
FOLDER), changes bytes or structure by lot, and lints the result in worker processes with a limit on memory. A
traceback, more than five seconds of CPU, or more than 500 MB is a failure; the file is then kept in ``artifacts/fuzz``.
"""

from __future__ import annotations

import multiprocessing
import os
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

from urdfkit.errors import UrdfkitError
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.resources import robots_dir

SECONDS = 5.0
BYTES = 500 * 10**6
"""More than a Python with the linter takes by itself: what one file may add to it."""

ROOT = Path(__file__).parents[2]

_NASTY = (
    b"",
    b"\x00",
    b"<",
    b">",
    b"&",
    b'"',
    b"${",
    b"}",
    b"${9**9}",
    b"${'a'*10}",
    b"$(arg x)",
    b"$(find x)",
    b"$(eval 1/0)",
    b"<!--",
    b"-->",
    b"]]>",
    b"<![CDATA[",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    "é😀\u202e".encode(),
    b"1e999",
    b"nan",
    b"-",
    b"0x10",
    b"1,5",
    b"xacro:",
    b"</robot>",
    b"<robot>",
    b"&lt;",
    b"&bomb;",
    b"package://a/../../b.stl",
    b"${xacro.load_yaml('x')}",
)


_GROWING = (
    "9**9**9",
    "10**9 * 'x'",
    "[0] * 10**10",
    "1 &lt;&lt; 10**9",
    "list(range(10**9))",
    "python.sum(range(10**12))",
    "python.sum(i * j for i in range(10**5) for j in range(10**5))",
    "'%099999999d' % 1",
    "'x'.ljust(10**10)",
    "factorial(10**7)",
    "(lambda f: f(f))(lambda f: f(f) + f(f))",
    "(lambda f: f(f, 40))(lambda f, n: 1 if n == 0 else f(f, n - 1) + f(f, n - 1))",
    "[x.extend(x) for x in [[1]] for i in range(99)]",
    "list(map(list, map(range, [99999] * 99999)))",
    "str([[[[0] * 99] * 99] * 99])",
    "round(5, -10**9)",
    "math.prod([10**1000] * 9999)",
    "','.join(['x' * 9999] * 999)",
)
"""Expressions that Python would go on with until the memory is full."""

_WRAPPED = (
    "({})",
    "[{}]",
    "[{} for i in range(99)]",
    "len(str({}))",
    "({}) * 2",
    "max([{}, 1])",
    "lambda: {}",
    "{} or 1",
)


def hostile(content: bytes, lot: random.Random) -> bytes:
    """Put expressions, properties, macros or blocks that grow without end into a file."""
    kind = lot.randrange(4)
    if kind == 0:
        expression = lot.choice(_GROWING)
        for _ in range(lot.randrange(3)):
            expression = lot.choice(_WRAPPED).format(expression)
        if lot.random() < 0.2:
            at = lot.randrange(len(expression))
            expression = expression[:at] + expression[at + 1 :]
        values = list(re.finditer(rb'="([^"<]*)"', content))
        if values:
            found = lot.choice(values)
            command = b"$(eval %s)" if lot.random() < 0.2 else b"${%s}"
            return content[: found.start(1)] + command % expression.encode() + content[found.end(1) :]
    levels, width = lot.randrange(3, 12), lot.randrange(2, 12)
    inner = lot.choice(('<link name="x"/>', "<gazebo/>", '<link name="${1 + 1}"/>', ""))
    if kind == 1:
        lines = [f'<xacro:macro name="m0">{inner}</xacro:macro>']
        lines += [f'<xacro:macro name="m{n}">{f"<xacro:m{n - 1}/>" * width}</xacro:macro>' for n in range(1, levels)]
        lines.append(f"<xacro:m{levels - 1}/>")
    elif kind == 2:
        lines = [f'<xacro:property name="p0">{inner}</xacro:property>']
        insert = '<xacro:insert_block name="p{}"/>'
        block = '<xacro:property name="p{}">{}</xacro:property>'
        lines += [block.format(n, insert.format(n - 1) * width) for n in range(1, levels)]
        lines.append(insert.format(levels - 1))
    else:
        value = lot.choice(("${{p{0}}}" * width, "${{p{0} * 2}}", "${{[p{0}, p{0}]}}", "${{p{0} + p{0}}}"))
        lines = ['<xacro:property name="p0" value="lol 1"/>']
        lines += [f'<xacro:property name="p{n}" value="{value.format(n - 1)}"/>' for n in range(1, 30)]
        lines.append('<link name="${p29}"/>')
    return content.replace(b"</robot>", "\n".join(lines).encode() + b"\n</robot>")


def mutated(content: bytes, lot: random.Random) -> bytes:
    """Change a file: a few bytes, a few elements, or what is computed."""
    if lot.random() < 0.2:
        content = hostile(content, lot)
        if lot.random() < 0.7:
            return content
    for _ in range(lot.choice((1, 1, 1, 2, 3, 8))):
        content = lot.choice((_bytes, _bytes, _element, _attribute, _word))(content, lot)
    return content


def _bytes(content: bytes, lot: random.Random) -> bytes:
    at = lot.randrange(len(content) + 1)
    kind = lot.randrange(5)
    if kind == 0:
        return content[:at] + bytes([lot.randrange(256)]) + content[at + 1 :]
    if kind == 1:
        return content[:at] + content[at + lot.choice((1, 2, 8, 64)) :]
    if kind == 2:
        return content[:at] + lot.choice(_NASTY) + content[at:]
    if kind == 3:
        end = min(len(content), at + lot.randrange(1, 200))
        return content[:end] + content[at:end] * lot.choice((1, 2, 20)) + content[end:]
    return content[:at]


def _element(content: bytes, lot: random.Random) -> bytes:
    """Take an element away, double it, or put it somewhere else."""
    elements = list(re.finditer(rb"<([\w:]+)(?:\s[^<>]*)?/>|<([\w:]+)(?:\s[^<>]*)?>.*?</\2\s*>", content, re.S))
    if not elements:
        return content
    found = lot.choice(elements)
    kind = lot.randrange(4)
    if kind == 0:
        return content[: found.start()] + content[found.end() :]
    if kind == 1:
        return content[: found.end()] + found[0] + content[found.end() :]
    if kind == 2:
        return content.replace(
            b"<" + (found[1] or found[2]), b"<" + lot.choice((b"x", b"link", b"xacro:if", b"gazebo"))
        )
    place = lot.choice(elements).start()
    return content[:place] + found[0] + content[place:]


def _attribute(content: bytes, lot: random.Random) -> bytes:
    """Give an attribute another value, another name, or take it away."""
    attributes = list(re.finditer(rb'\s([\w:]+)="([^"]*)"', content))
    if not attributes:
        return content
    found, other = lot.choice(attributes), lot.choice(attributes)
    name, other_name = found[1], other[1]
    texts = (other[2], *lot.sample(_NASTY, 3))
    choices = [b"", b' %s="%s"' % (other_name, found[2]), *(b' %s="%s"' % (name, text) for text in texts)]
    new = lot.choice(choices)
    return content[: found.start()] + new + content[found.end() :]


def _word(content: bytes, lot: random.Random) -> bytes:
    """Replace a word, everywhere, by another of the file."""
    words = sorted(set(re.findall(rb"[A-Za-z_]\w{2,}", content)))
    return content.replace(lot.choice(words), lot.choice(words), lot.choice((1, -1))) if words else content


def seeds(folder: Path | None) -> list[Path]:
    """Return the files to start from."""
    folders = [robots_dir(), *([folder] if folder is not None else [])]
    return sorted(
        path
        for place in folders
        for path in place.rglob("*")
        if path.suffix in (".urdf", ".xacro") and path.stat().st_size < 300_000
    )


class Hang(BaseException):
    """Too much time has passed; not an `Exception`, so that nothing takes it for a fault of the file."""


def _stop(*_: object) -> None:
    raise Hang


def judged(path: Path) -> str:
    """Lint a file; return ``found``, ``refused``, or what went wrong."""
    signal.signal(signal.SIGPROF, _stop)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    start = time.process_time()
    try:
        run([Entry(path)], Options(guess_target=True))
    except UrdfkitError as error:
        return "refused" if "\n" not in str(error) else f"a message of several lines: {error}"
    except Hang:
        return f"more than {SECONDS:g} s: {traceback.format_exc(limit=-3)}"
    except MemoryError:
        return f"more than {BYTES / 1e6:.0f} MB"
    except BaseException:
        return traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        _times.append(time.process_time() - start)
    return "found"


_times: list[float] = []


def work(job: tuple[int, int, str]) -> tuple[Counter[str], list[tuple[int, str]], float]:
    """Judge the mutants of one range of numbers; return how they went, the failures, and the longest time."""
    first, last, folder = job
    files = seeds(Path(folder) if folder else None)
    counts: Counter[str] = Counter()
    failures: list[tuple[int, str]] = []
    _times.clear()
    with tempfile.TemporaryDirectory() as place:
        for number in range(first, last):
            lot = random.Random(number)
            original = lot.choice(files)
            path = Path(place) / original.name
            path.write_bytes(mutated(original.read_bytes(), lot))
            outcome = judged(path)
            counts[outcome if outcome in ("found", "refused") else "failed"] += 1
            if outcome not in ("found", "refused"):
                failures.append((number, f"{original}\n{outcome}"))
                keep = ROOT / "artifacts" / "fuzz"
                keep.mkdir(parents=True, exist_ok=True)
                (keep / f"{number}{''.join(original.suffixes[-2:])}").write_bytes(path.read_bytes())
            path.unlink()
    return counts, failures, max(_times, default=0.0)


def limit_memory() -> None:
    """Let this process have no more than it has, and the limit."""
    with Path("/proc/self/statm").open() as sizes:
        used = int(sizes.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    resource.setrlimit(resource.RLIMIT_AS, (used + BYTES, used + BYTES))


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20_000
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    folder = sys.argv[3] if len(sys.argv) > 3 else ""
    step = max(1, min(250, count // 4))
    jobs = [(n, min(n + step, seed + count), folder) for n in range(seed, seed + count, step)]
    counts: Counter[str] = Counter()
    longest = 0.0
    cores = len(os.sched_getaffinity(0))
    with multiprocessing.get_context("spawn").Pool(cores, limit_memory, maxtasksperchild=4) as pool:
        for some, failures, slowest in pool.imap_unordered(work, jobs):
            counts += some
            longest = max(longest, slowest)
            for number, what in failures:
                print(f"{number}: {what}", flush=True)
    print(f"{counts.total()} files: {dict(counts)}; longest {longest:.2f} s of CPU")
    return 1 if counts["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
