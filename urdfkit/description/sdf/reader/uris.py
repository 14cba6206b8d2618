"""Resolve URIs in SDF to local files: models by name, and meshes; nothing is downloaded."""

import re
from pathlib import Path

from urdfkit.description.packages.existence import exists, is_file
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.sdf.model_library import ALIKE, FOLDER, model_file, model_names, replacement_of
from urdfkit.description.sdf.reader.reading_state import NEWEST, Context
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import document_of, read_source, shown_path
from urdfkit.errors import ResourceError, did_you_mean

_REMOTE = re.compile(r"^(https?|fuel)://", re.IGNORECASE)


def find_file(context: Context, uri: Element) -> Path:
    """Return the file of a mesh URI.

    Args:
        context: the file that contains the URI; plain paths are relative to it.
        uri: the element that contains the URI.

    Raises:
        ResourceError: the file does not exist, or is on the network.
    """
    _refuse_remote(uri)
    scheme, _, rest = uri.text.partition("://")
    name, _, inside = rest.partition("/")
    if scheme == "model":
        # A model has the name of its folder, so its own files need no search.
        for folder in context.path.parents:
            if folder.name == name and is_file(folder / inside):
                return folder / inside
    try:
        return context.packages.resolve(uri.text, context.path)
    except ResourceError as error:
        raise error.at(uri.origin.position) from None


def find_model(context: Context, uri: Element) -> Path:
    """Return the SDF or URDF file of an included model.

    User models come first (the folders around the file, GAZEBO_MODEL_PATH, GZ_SIM_RESOURCE_PATH, packages),
    then bundled models; a similar bundled model is used with a note.

    Raises:
        ResourceError: unknown model; names the most similar model.
    """
    _refuse_remote(uri)
    text = uri.text.strip()
    scheme, separator, rest = text.partition("://")
    if separator and scheme not in ("model", "package", "file"):
        raise ResourceError(
            f"`{text}`: models are read from model://, package://, file:// or a path", position=uri.origin.position
        )
    name, _, inside = rest.partition("/") if scheme == "model" else ("", "", "")
    if name and not inside and FOLDER in context.path.parents and (ours := model_file(name)):
        return ours
    path = _users(context, text, name, inside)
    if path is not None:
        return _entry(path, uri)
    if name and not inside.strip("/") and (found := replacement_of(name)) is not None:
        if found[0] != name or name in ALIKE:
            which = "model" if found[0] == name else f"model `{found[0]}`"
            context.note(uri, f"{text}: the bundled {which} is used instead", "bundled")
        return found[1]
    if name:
        hint = did_you_mean(name, model_names())
        where = "on GAZEBO_MODEL_PATH, GZ_SIM_RESOURCE_PATH, near this file or among the bundled models"
        raise ResourceError(f"no model `{name}` {where}" + hint, position=uri.origin.position)
    raise ResourceError(f"no model {text}" + near_path(context.path.parent / text), position=uri.origin.position)


def _users(context: Context, text: str, name: str, inside: str) -> Path | None:
    if not name:
        try:
            return context.packages.resolve(text.removeprefix("file://"), context.path)
        except ResourceError:
            return None
    for folder in context.path.parents[:5]:
        for around in (folder / "models" / name, folder / name):
            if _is_model(around) or (inside and exists(around / inside)):
                return around / inside
    try:
        found = context.packages.find(name)
    except ResourceError:
        return None
    if FOLDER in found.parents:
        return None
    return found / inside if inside or _is_model(found) else None


def _is_model(folder: Path) -> bool:
    return is_file(folder / "model.config") or is_file(folder / "model.sdf")


def _entry(path: Path, uri: Element) -> Path:
    """Return the model file; for a folder, the newest file in its model.config."""
    if is_file(path):
        return path
    manifest, plain = path / "model.config", path / "model.sdf"
    if not is_file(manifest):
        manifest = path / "manifest.xml"
    if is_file(manifest):
        root = document_of(read_source(manifest, shown_as=shown_path(manifest)))
        named = [(_version(each), each.text.strip()) for each in root.find_all("sdf") if each.text.strip()]
        fit = [each for each in named if each[0] <= NEWEST] or named
        if fit:
            found = path / max(fit, key=lambda each: each[0])[1]
            if is_file(found):
                return found
            raise ResourceError(
                f"no file {shown_path(found)}" + near_path(found), position=uri.origin.position, kind="file"
            )
    if is_file(plain):
        return plain
    raise ResourceError(f"no model.config and no model.sdf in {shown_path(path)}", position=uri.origin.position)


def _version(element: Element) -> tuple[int, ...]:
    words = (element.get("version") or "1.0").split(".")
    return tuple(int(word) if word.isdigit() else 0 for word in words)


def _refuse_remote(uri: Element) -> None:
    if not uri.text.strip():
        raise ResourceError(f"<{uri.tag}> is empty", position=uri.origin.position)
    if _REMOTE.match(uri.text.strip()):
        words = [word for word in uri.text.strip().lower().split("/") if word and not word.isdigit()]
        near = replacement_of(words[-1])
        hint = f"; use the bundled model://{near[0]}" if near else "; download it and name its folder: model://…"
        raise ResourceError(f"{uri.text}: nothing is downloaded" + hint, position=uri.origin.position)
