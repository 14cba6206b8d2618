"""Rows of ``urdfkit inertia``: present and computed values of one link."""

from __future__ import annotations

from urdfkit.errors import UrdfkitError

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from typing import Any

    from urdfkit.description.urdf.robot import Inertial, Link
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.fixes.inertia_edits import ComputedInertial
    from urdfkit.lint.model.model import Model

MAX_RATIO = 10.0
"""Ratio to the moments of shapes of uniform density above which a moment is reported; motors explain smaller ones."""


def row_of(
    arguments: argparse.Namespace, model: Model, link: Link, findings: list[Finding], *, alone: bool
) -> tuple[dict[str, Any], ComputedInertial | None]:
    """Return the present and the computed values of a link as in ``--json``, and the latter as a record.

    Args:
        arguments: those of the command: mass, density and kind of shapes.
        model: the robot.
        link: one of its links.
        findings: the linter's findings on its inertia.
        alone: whether it is the only link, so that values that cannot be computed are errors.

    Raises:
        UrdfkitError: the values of the only link cannot be computed.
    """
    from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS
    from urdfkit.lint.fixes.inertia_edits import compute_inertial

    at = (link.inertial.element if link.inertial is not None else link.element).origin.position
    row: dict[str, Any] = {
        "link": link.name,
        "file": at.file,
        "line": at.line,
        "present": _present(link.inertial),
        "computed": None,
        "shapes": None,
        "findings": [{"code": f.code, "severity": f.severity, "message": f.message} for f in findings],
        "notes": [],
        "written": [],
    }
    try:
        value = compute_inertial(model, link, mass=arguments.mass, density=arguments.density, kind=arguments.kind)
    except UrdfkitError as error:
        if alone:
            raise
        row["notes"] = [error.message]
        return row, None
    row["computed"] = {
        "mass": value.mass,
        "xyz": list(value.xyz),
        "rpy": list(link.inertial.origin.rpy) if link.inertial is not None else [0.0, 0.0, 0.0],
        "inertia": dict(zip(COMPONENTS, value.tensor, strict=True)),
    }
    row["findings"] += _deviations(row["present"], row["computed"])
    row["shapes"] = {"kind": value.kind, "count": value.count, "volume": value.volume, "shared": value.shared}
    row["notes"] = list(value.notes)
    return row, value


def _deviations(present: dict[str, Any] | None, computed: dict[str, Any]) -> list[dict[str, Any]]:
    """Return findings about moments that differ from those of the shapes by more than `MAX_RATIO`."""
    tensor = (present or {}).get("inertia")
    if tensor is None:
        return []
    findings = []
    for name in ("ixx", "iyy", "izz"):
        ratio = tensor[name] / computed["inertia"][name]
        if not 1.0 / MAX_RATIO < ratio < MAX_RATIO:
            message = f"{name} is {ratio:.3g} times that of the shapes"
            findings.append({"code": None, "severity": "warning", "message": message})
    return findings


def _present(inertial: Inertial | None) -> dict[str, Any] | None:
    from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS

    if inertial is None:
        return None
    tensor = inertial.inertia
    return {
        "mass": inertial.mass,
        "xyz": list(inertial.origin.xyz),
        "rpy": list(inertial.origin.rpy),
        "inertia": {name: getattr(tensor, name) for name in COMPONENTS} if tensor is not None else None,
    }


def text_of(row: dict[str, Any]) -> str:
    """Return a row for the terminal, with the values next to each other."""
    present, computed, shapes = row["present"], row["computed"], row["shapes"]
    lines = [f"{row['link']}  {row['file']}:{row['line']}"]
    if computed is not None:
        shared = f", of which {shapes['shared']:.4g} m³ are overlaps, counted once" if shapes["shared"] else ""
        plural = "s" if shapes["count"] > 1 else ""
        lines.append(f"  {shapes['count']} {shapes['kind']} shape{plural}, {shapes['volume']:.6g} m³ in total{shared}")
        lines.append(f"  {'':14}{'present':>16}{'computed':>16}")
        pairs = [("mass [kg]", present and present["mass"], computed["mass"])]
        middle = present["xyz"] if present else [None] * 3
        pairs += [(f"{axis} [m]", a, b) for axis, a, b in zip("xyz", middle, computed["xyz"], strict=True)]
        tensor = (present or {}).get("inertia") or {}
        pairs += [(f"{name} [kg·m²]", tensor.get(name), b) for name, b in computed["inertia"].items()]
        scale = max(computed["inertia"].values())
        lines += [
            f"  {name:14}{_number(a, scale):>16}{_number(b, scale):>16}{_times(a, b, scale)}" for name, a, b in pairs
        ]
    lines += [
        f"  {finding['severity']}: {finding['code'] or ''}{' ' if finding['code'] else ''}{finding['message']}"
        for finding in row["findings"]
    ]
    lines += [f"  note: {note}" for note in row["notes"]]
    return "\n".join(lines)


def _number(value: float | None, scale: float) -> str:
    return "-" if value is None else "0" if abs(value) < 1e-9 * scale else f"{value:.6g}"


def _times(present: float | None, computed: float, scale: float) -> str:
    """Return how many times too large or small a value is; empty where the ratio is less than 1.5."""
    if present is None or present <= 0.0 or computed <= 1e-9 * scale:
        return ""
    ratio = present / computed
    return f"  {ratio:.3g} times" if not 2.0 / 3.0 < ratio < 1.5 else ""
