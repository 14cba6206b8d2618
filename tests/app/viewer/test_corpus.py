"""Every robot of the corpus is shown, without its meshes, and with more defects."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.app.viewer.findings_panel import FindingsPanel
from urdfkit.app.viewer.session import Session
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.description import expand
from urdfkit.resources import find_model
from urdfkit.view.html_export import Recording

CORPUS = Path(__file__).parents[3].parent / "shared" / "corpus"
NUMBER = r"[-+]?[\d.]+(?:[eE][-+]?\d+)?"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not (CORPUS / "expected.json").is_file(), reason="no corpus next to the checkout"),
]


def impossible(text: str) -> str:
    return re.sub(rf'(<inertia\s[^>]*?ixx=")({NUMBER})"', lambda m: f'{m[1]}{100 * abs(float(m[2])) + 1}"', text)


VARIANTS: dict[str, Callable[[str], str]] = {
    "as written": str,
    "no inertials": lambda text: re.sub(r"<inertial>.*?</inertial>|<inertial/>", "", text, flags=re.DOTALL),
    "impossible tensors": impossible,
    "negative masses": lambda text: re.sub(rf'(<mass value=")({NUMBER}")', r"\1-\2", text),
    "unknown plugins": lambda text: re.sub(
        r'<plugin>[^<]*</plugin>|(<plugin\b[^>]*filename=")[^"]*',
        lambda m: f"{m[1]}libgone.so" if m[1] else "<plugin>acme/Gone</plugin>",
        text,
    ),
}
"""The corpus contains no meshes."""


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_robot_is_shown_with_a_repair_for_each_missing_mesh(variant: str, tmp_path: Path) -> None:
    models = json.loads((CORPUS / "expected.json").read_text())["models"]
    if variant != "as written":  # a third of the robots for each defect, another third for the next
        models = models[list(VARIANTS).index(variant) % 3 :: 3]
    changed = placeholders = 0
    for i, entry in enumerate(models):
        path, arguments = CORPUS / entry["entry"], entry.get("args", {})
        model = find_model([str(path), *(f"{name}:={value}" for name, value in arguments.items())])
        if variant != "as written":
            text = expand(path, arguments=arguments)
            path = tmp_path / f"{i}.urdf"
            path.write_text(VARIANTS[variant](text))
            changed += path.read_text() != text
            model = find_model([str(path)])
        shown = ShownRobot.read(model)
        Session(Recording(), model, shown, FindingsPanel(model)).show()
        assert len(shown.kinematics.link_names) == entry["links"], entry["entry"]
        missing = {shape.body for shape in shown.scene.shapes if shape.is_placeholder}
        assert missing == {repair.link for repair in shown.repairs if repair.kind == "mesh"}, entry["entry"]
        placeholders += len(missing)
    assert placeholders > 3 * len(models)
    assert variant == "as written" or changed > 5
