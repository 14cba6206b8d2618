"""Write all or nothing: to a temporary place beside the target, then move."""

from __future__ import annotations

import os
import re
import shutil
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from urdfkit.errors import ResourceError, UrdfkitError

_STAGE = ".urdfkit-"


def write_text(path: Path, text: str) -> None:
    r"""Replace the contents of a file, or leave it as it was.

    The permissions of an existing file are kept, a symbolic link stays one, and line ends are written as given
    (``\n`` is not translated).

    Args:
        path: the file; its folder has to exist.
        text: what it shall hold, written as UTF-8.

    Raises:
        ResourceError: it cannot be written.
    """
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """Replace the contents of a file, or leave it as it was; see `write_text`.

    Args:
        path: the file; its folder has to exist.
        content: what it shall hold.

    Raises:
        ResourceError: it cannot be written.
    """
    target = path.resolve()
    temporary: str | None = None
    try:
        mode = target.stat().st_mode & 0o7777 if target.exists() else 0o666 & ~_umask()
        descriptor, temporary = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        Path(temporary).chmod(mode)
        Path(temporary).replace(target)
        temporary = None
    except OSError as error:
        raise ResourceError(f"cannot write {path}: {error.strerror}") from error
    finally:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)


@contextmanager
def staging(folder: Path) -> Iterator[Path]:
    """Provide a temporary folder inside `folder`, gone afterwards whatever happens.

    It lies on the same file system, so that `move_into_place` is a rename. What programs that were killed have left of
    their own is removed.

    Errors name what would have been written by its place in `folder`: nobody has heard of the temporary one.

    Args:
        folder: has to exist.

    Raises:
        ResourceError: nothing can be written there.
    """
    _sweep(folder)
    with _temporary(folder) as place, _named_by_their_place(place, folder):
        yield place


@contextmanager
def _temporary(folder: Path) -> Iterator[Path]:
    """Make the temporary folder, and take it away however the body ends, also when told to end in between."""
    place: Path | None = None
    try:
        with undisturbed():
            try:
                place = Path(tempfile.mkdtemp(prefix=f"{_STAGE}{_host()}-{os.getpid()}-", dir=folder))
            except OSError as error:
                raise ResourceError(f"cannot write into {folder}: {error.strerror}") from error
        yield place
    finally:
        if place is not None:
            with undisturbed():
                shutil.rmtree(place, ignore_errors=True)


@contextmanager
def _named_by_their_place(place: Path, folder: Path) -> Iterator[None]:
    """Name in errors, in the place of the temporary folder, the one that it is for."""
    try:
        yield
    except BrokenPipeError:  # no file of it: whoever reads what is printed has gone
        raise
    except OSError as error:
        written = Path(error.filename) if isinstance(error.filename, str) else place
        if not written.is_relative_to(place):
            raise
        raise ResourceError(f"cannot write {folder / written.relative_to(place)}: {error.strerror}") from error
    except UrdfkitError as error:
        if place.name not in str(error):
            raise
        there = {f"{place}/": "" if folder == Path() else f"{folder}/", f"{place.resolve()}/": f"{folder.resolve()}/"}
        said = str(error)
        for hidden, shown in there.items():
            said = said.replace(hidden, shown)
        raise ResourceError(said.replace(f"{place.name}/", "")) from error


def move_into_place(staged: Path, folder: Path) -> list[Path]:
    """Move everything in `staged` into `folder`; nothing is overwritten, and if one move fails all are undone.

    Args:
        staged: a folder on the same file system.
        folder: has to exist.

    Returns:
        The new paths, sorted.

    Raises:
        ResourceError: something of that name is there already, or it cannot be written.
    """
    moves = [(child, folder / child.name) for child in sorted(staged.iterdir())]
    for _, target in moves:
        if os.path.lexists(target):
            raise ResourceError(f"{target} is already there; nothing is overwritten")
    done: list[tuple[Path, Path]] = []
    with undisturbed():
        try:
            for source, target in moves:
                source.rename(target)
                done.append((source, target))
        except OSError as error:
            raise ResourceError(f"cannot write {target}: {error.strerror}") from error
        finally:
            if len(done) < len(moves):
                for source, target in reversed(done):
                    target.rename(source)
    return [target for _, target in moves]


@contextmanager
def undisturbed() -> Iterator[None]:
    """Let Ctrl-C, a request to end and a terminal that is closed wait until the body is done.

    To block the signals would not do: another thread, such as a library's, would take them, and Python would act on
    them here all the same.
    """
    arrived: list[int] = []
    before = {}
    if threading.current_thread() is threading.main_thread():
        for name in ("SIGINT", "SIGTERM", "SIGHUP"):  # the last is not everywhere
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) not in (None, signal.SIG_IGN):
                before[number] = signal.signal(number, lambda number, _: arrived.append(number))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in dict.fromkeys(arrived):
            signal.raise_signal(number)


def _sweep(folder: Path) -> None:
    """Remove the temporary folders of programs of this machine that are no more."""
    if not hasattr(os, "uname"):  # where there is no harmless way to ask whether a process is alive
        return
    for path in folder.glob(f"{_STAGE}{_host()}-*-*"):
        process = path.name.removeprefix(f"{_STAGE}{_host()}-").partition("-")[0]
        if process.isdigit() and not _is_alive(int(process)):
            shutil.rmtree(path, ignore_errors=True)


def _is_alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _host() -> str:
    return re.sub(r"[^A-Za-z0-9]", "", os.uname().nodename) if hasattr(os, "uname") else "here"


def _umask() -> int:
    current = os.umask(0o022)
    os.umask(current)
    return current
