"""New findings: those of rules that report more findings than before."""

from __future__ import annotations

from urdfkit.lint.engine.run import run
from urdfkit.lint.fixes.regressions import new_findings, unmatched
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options


def test_a_finding_with_another_text_is_new_only_if_its_rule_reports_more(write):
    path = write("r.urdf", "")

    def outcome(*masses):
        links = "".join(
            f'<link name="l{mass}"><inertial><mass value="{mass}"/>'
            '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
            for mass in masses
        )
        path.write_text(f'<robot name="r">{links}</robot>')
        return run([Entry(path)], Options(select=("I501",)), keep_going=True)

    before = outcome(-1)
    assert len(before.findings) == 1
    assert len(list(unmatched(outcome(-2).findings, before.findings))) == 1
    assert list(new_findings(before, outcome(-2))) == []
    assert [finding.link for finding in new_findings(before, outcome(-1, -2))] == ["l-2"]
