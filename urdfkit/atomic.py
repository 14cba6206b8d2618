"""Atomic writes: to a temporary file or folder next to the target, which is then moved."""

from __future__ import annotations

import os
import re
import shutil
import signal
import tempfile
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from urdfkit.errors import ResourceError, UrdfkitError, UsageError
from urdfkit.file_replacement import CONTENTS, check_unchanged, replace_files, restore_files, write_list
from urdfkit.missing_files import missing_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.file_replacement import Replacement

_TEMPORARY_PREFIX = ".urdfkit-"
_MOVES = ".urdfkit-moves"
"""File in a temporary folder that lists the paths of a move into place, for `clean_up`."""


def check_output_files(option: str, files: Iterable[Path]) -> None:
    """Reject files that cannot be written, before a long computation starts. No command creates their folders.

    Args:
        option: name of the option, such as ``--save-image``.
        files: files that will be written.

    Raises:
        UsageError: the folder does not exist or is not writable, or the file is a folder.
    """
    for file in files:
        folder = file.parent
        if file.is_dir():
            raise UsageError(f"{option}: {file} is a folder")
        if not folder.is_dir():
            raise UsageError(f"{option}: cannot write {file}: {missing_path(folder, 'folder')}")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise UsageError(f"{option}: cannot write {file}: {folder} is not writable")


def write_text(path: Path, text: str) -> None:
    r"""Replace the contents of a file, or leave it as it was.

    The permissions of an existing file are kept; a symbolic link, device or pipe stays one; line ends are written as
    given (``\n`` is not translated).

    Args:
        path: the file; its folder must exist.
        text: the new content, written as UTF-8.

    Raises:
        ResourceError: it cannot be written.
    """
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """Replace the contents of a file, or leave it as it was; see `write_text`.

    Args:
        path: the file; its folder must exist.
        content: the new content.

    Raises:
        ResourceError: it cannot be written.
    """
    target = path.resolve()
    if target.exists() and not target.is_file() and not target.is_dir():  # a device or a named pipe stays one
        try:
            with target.open("wb") as file:
                file.write(content)
        except OSError as error:
            raise ResourceError(f"cannot write {path}: {error.strerror}") from error
        return
    temporary: str | None = None
    clean_up(target.parent)
    with undisturbed():
        try:
            mode = target.stat().st_mode & 0o7777 if target.exists() else 0o666 & ~_umask()
            descriptor, temporary = tempfile.mkstemp(prefix=_temporary_name(), dir=target.parent)
            with os.fdopen(descriptor, "wb") as file:
                file.write(content)
            Path(temporary).chmod(mode)
            Path(temporary).replace(target)
            temporary = None
        except FileNotFoundError as error:
            raise ResourceError(f"cannot write {path}: {missing_path(path.parent, 'folder')}") from error
        except OSError as error:
            raise ResourceError(f"cannot write {path}: {error.strerror}") from error
        finally:
            if temporary is not None:
                Path(temporary).unlink(missing_ok=True)


@contextmanager
def staging(folder: Path) -> Iterator[Path]:
    """Provide a temporary folder inside `folder` that is always removed afterwards.

    It lies on the same file system, so that `move_into_place` is a rename. Temporary folders
    of killed programs are removed.

    Errors name the target path in `folder` instead of the temporary one.

    Args:
        folder: must exist.

    Raises:
        ResourceError: nothing can be written there.
    """
    clean_up(folder)
    with _temporary(folder) as place, _errors_name_target(place, folder):
        yield place


@contextmanager
def _temporary(folder: Path) -> Iterator[Path]:
    """Create the temporary folder, and remove it however the body ends, also on a signal."""
    place: Path | None = None
    try:
        with undisturbed():
            try:
                place = Path(tempfile.mkdtemp(prefix=_temporary_name(), dir=folder))
            except OSError as error:
                raise ResourceError(f"cannot write into {folder}: {error.strerror}") from error
        yield place
    finally:
        if place is not None:
            with undisturbed():
                shutil.rmtree(place, ignore_errors=True)


@contextmanager
def _errors_name_target(place: Path, folder: Path) -> Iterator[None]:
    """Replace the temporary folder by the target folder in error messages."""
    try:
        yield
    except BrokenPipeError:  # not about a file: the reader of the output has closed it
        raise
    except OSError as error:
        written = Path(error.filename) if isinstance(error.filename, str) else place
        if not written.is_relative_to(place):
            raise
        raise ResourceError(f"cannot write {folder / written.relative_to(place)}: {error.strerror}") from error
    except UrdfkitError as error:
        if place.name not in str(error):
            raise
        shown_folder = "" if folder == Path() else f"{folder}/"
        replacements = {f"{place}/": shown_folder, f"{place.resolve()}/": f"{folder.resolve()}/"}
        message = str(error)
        for hidden, shown in replacements.items():
            message = message.replace(hidden, shown)
        raise ResourceError(message.replace(f"{place.name}/", "")) from error


def move_into_place(staged: Path, folder: Path) -> list[Path]:
    """Move the content of `staged` into `folder`; nothing is overwritten, and if one move fails all are undone.

    Args:
        staged: a folder on the same file system.
        folder: must exist.

    Returns:
        The new paths, sorted.

    Raises:
        ResourceError: a path of that name exists, or it cannot be written.
    """
    moves = [(child, folder / child.name) for child in sorted(staged.iterdir()) if child.name != CONTENTS]
    for _, target in moves:
        if os.path.lexists(target):
            raise ResourceError(f"{target} already exists; nothing is overwritten")
    done: list[tuple[Path, Path]] = []
    with undisturbed():
        if len(moves) > 1:  # one move is atomic; of several, a killed program makes only some
            write_list(staged / _MOVES, [target.name for _, target in moves])
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


def replace_and_move(changes: Sequence[Replacement], staged: Path, folder: Path) -> list[Path]:
    """Write files, then move the content of `staged` into `folder`: all or nothing.

    If the program is killed on the way, the next `clean_up` of the folder of `staged` restores the old files, unless
    one of them was edited since.

    Args:
        changes: the files, in the order of writing.
        staged: a folder of `staging`.
        folder: see `move_into_place`.

    Returns:
        The moved paths, sorted.

    Raises:
        ResourceError: a file was changed or created since it was read, a path exists, or it cannot be written.
    """
    check_unchanged(changes)
    with undisturbed():
        try:
            replace_files(changes, staged)
            return move_into_place(staged, folder)
        except BaseException:
            restore_files(staged)
            raise


@contextmanager
def undisturbed() -> Iterator[None]:
    """Delay SIGINT, SIGTERM and SIGHUP until the body is done.

    Blocking the signals is not enough: another thread, such as a library's, would receive them, and Python would run
    their handlers here.
    """
    arrived: list[int] = []
    before = {}
    if threading.current_thread() is threading.main_thread():
        for name in ("SIGINT", "SIGTERM", "SIGHUP"):  # SIGHUP does not exist on every platform
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


def clean_up(folder: Path) -> None:
    """Remove the temporary files of killed programs of this machine, and complete or revert what they had begun.

    Moves are completed; replaced files are restored.

    Args:
        folder: may be missing.
    """
    if not hasattr(os, "uname"):  # no safe test for a running process on this platform
        return
    for path in folder.glob(f"{_TEMPORARY_PREFIX}{_host()}-*-*"):
        process = path.name.removeprefix(f"{_TEMPORARY_PREFIX}{_host()}-").partition("-")[0]
        if process.isdigit() and not is_alive(int(process)):
            with suppress(OSError):
                if path.is_dir():
                    _complete(path, folder)
                    restore_files(path)
                    shutil.rmtree(path)
                else:
                    path.unlink()


def _complete(staged: Path, folder: Path) -> None:
    """Move the remaining paths into place if at least one was moved; existing paths are not overwritten."""
    if not (staged / _MOVES).is_file():
        return
    names = (staged / _MOVES).read_text(encoding="utf-8").split("\n")
    remaining = [name for name in names if os.path.lexists(staged / name)]
    if any(os.path.lexists(folder / name) for name in names if name not in remaining):
        for name in remaining:
            if not os.path.lexists(folder / name):
                (staged / name).rename(folder / name)


def is_alive(process: int) -> bool:
    """Return whether a process with this number, above 0, exists."""
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:
        return True
    return True


def _temporary_name() -> str:
    return f"{_TEMPORARY_PREFIX}{_host()}-{os.getpid()}-"


def _host() -> str:
    return re.sub(r"[^A-Za-z0-9]", "", os.uname().nodename) if hasattr(os, "uname") else "here"


def _umask() -> int:
    current = os.umask(0o022)
    os.umask(current)
    return current
