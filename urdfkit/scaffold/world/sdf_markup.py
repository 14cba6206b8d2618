"""SDF elements that all versions from 1.6 to 1.11 interpret identically."""

from collections.abc import Iterable, Iterator, Sequence

from urdfkit.scaffold.world.shapes import ModelShape, SdfModel, inertia


def markup(models: Sequence[SdfModel], indent: str = "    ") -> str:
    """Return the ``<model>`` elements of a world.

    Args:
        models: the models of the world.
        indent: indentation of each line.
    """
    return "\n\n".join("\n".join(indent + line for line in _model(model)) for model in models)


def _model(model: SdfModel) -> Iterator[str]:
    yield f'<model name="{model.name}">'
    if any(model.place):
        x, y, yaw = model.place
        yield f"  <pose>{_numbers((x, y, 0, 0, 0, yaw))}</pose>"
    if model.mass is None:
        yield "  <static>true</static>"
    yield '  <link name="link">'
    if model.mass is not None:
        yield from (f"    {line}" for line in _inertial(model.shapes[0], model.mass))
    for shape in model.shapes:
        yield from (f"    {line}" for line in _element("collision", shape, ()))
        colour = f"{_numbers(shape.colour)} 1"
        looks = (f"<ambient>{colour}</ambient>", f"<diffuse>{colour}</diffuse>")
        yield from (f"    {line}" for line in _element("visual", shape, _inside("material", looks)))
    yield "  </link>"
    yield "</model>"


def _element(tag: str, shape: ModelShape, more: Iterable[str]) -> Iterator[str]:
    yield f'<{tag} name="{shape.name}_{tag}">'
    yield f"  <pose>{_numbers((*shape.centre, 0, 0, 0))}</pose>"
    if shape.kind == "box":
        sizes = [f"<size>{_numbers(shape.size)}</size>"]
    else:
        names = ("radius", "length")
        sizes = [f"<{name}>{_numbers((value,))}</{name}>" for name, value in zip(names, shape.size, strict=False)]
    yield from (f"  {line}" for line in _inside("geometry", _inside(shape.kind, sizes)))
    yield from (f"  {line}" for line in more)
    yield f"</{tag}>"


def _inertial(shape: ModelShape, mass: float) -> Iterator[str]:
    moments = zip(("ixx", "iyy", "izz"), inertia(shape, mass), strict=True)
    products = [(name, 0.0) for name in ("ixy", "ixz", "iyz")]
    terms = [f"<{name}>{value:.9g}</{name}>" for name, value in (*moments, *products)]
    yield from _inside(
        "inertial",
        (
            f"<pose>{_numbers((*shape.centre, 0, 0, 0))}</pose>",
            f"<mass>{_numbers((mass,))}</mass>",
            *_inside("inertia", terms),
        ),
    )


def _inside(tag: str, lines: Iterable[str]) -> Iterator[str]:
    yield f"<{tag}>"
    yield from (f"  {line}" for line in lines)
    yield f"</{tag}>"


def _numbers(values: Iterable[float]) -> str:
    """Return numbers rounded to micrometres, without ``-0``."""
    return " ".join(f"{round(value, 6) + 0.0:.10g}" for value in values)
