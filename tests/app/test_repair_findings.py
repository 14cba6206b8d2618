"""Repairs as rows of the findings panel."""

from pathlib import Path

from urdfkit.app.repair_findings import note_repairs, with_repairs
from urdfkit.defect_message import Suggestion
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.xml.source import Source
from urdfkit.position import Position


def repair(message: str, line: int, *, code: str | None = "G601", link: str | None = None) -> Repair:
    return Repair("mesh", code, message, Position("r.urdf", line, 1), link)


def row(code: str, line: int, **values) -> dict:
    return {
        "code": code,
        "file": "r.urdf",
        "line": line,
        "link": None,
        "joint": None,
        "about": [],
        "message": "m",
    } | values


def test_a_repair_joins_the_finding_of_its_rule_in_its_line() -> None:
    rows = [row("G601", 3, link="a"), row("G601", 4), row("G610", 3)]
    (first, *others) = with_repairs(rows, [repair("gone; a box", 3, link="b")])
    assert first["repair"] == "gone; a box"
    assert first["about"] == [{"link": "a"}, {"link": "b"}]
    assert all("repair" not in each for each in others)


def test_a_repair_joins_the_finding_that_stands_at_a_macro_call() -> None:
    chains = [[{"macro": "wheel"}]]
    rows = [row("G601", 9, link="b", chains=chains), row("G601", 8, link="a", chains=chains), row("G601", 7, link="c")]
    found = with_repairs(rows, [repair("gone; a box", 3, link="a"), repair("gone", 3, link="c")])
    assert [each.get("repair") for each in found] == [None, "gone; a box", None, "gone"]


def test_equal_repairs_share_one_row_with_all_links() -> None:
    repairs = [repair("gone", 3, link="a"), repair("gone", 5, link="b"), repair("broken", 7, code=None)]
    rows = with_repairs([], repairs, first=8)
    assert [(r["number"], r["message"], r["line"]) for r in rows] == [(8, "gone", 3), (9, "broken", 7)]
    assert rows[0]["about"] == [{"link": "a"}, {"link": "b"}]


def test_a_row_shows_its_source_line(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("r.urdf").write_text("<robot>\n <link/>\n</robot>\n")
    assert with_repairs([], [repair("x", 2)])[0]["lines"] == [" <link/>"]
    assert with_repairs([], [Repair("mass", None, "x", None)])[0]["lines"] == []


def test_the_source_of_many_rows_is_read_once(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "r.urdf").write_text("<robot>\n" * 9)
    reads, read = [], Source.read
    monkeypatch.setattr(Source, "read", lambda *words, **options: reads.append(1) or read(*words, **options))
    at = [Position(str(tmp_path / "r.urdf"), line, 1) for line in range(1, 9)]
    rows = with_repairs([], [Repair("mesh", "G601", f"no mesh {place.line}", place) for place in at])
    assert [row["lines"] for row in rows] == [["<robot>"]] * 8
    assert len(reads) == 1


def test_each_repair_is_printed_once(capsys) -> None:
    noted = note_repairs([repair("gone", 3, link="a"), repair("gone", 5, link="b")])
    assert capsys.readouterr().err == "urdfkit: warning: r.urdf:3:1: gone\n"
    assert note_repairs([repair("gone", 3), repair("new", 4)], noted) == {"gone", "new"}
    assert capsys.readouterr().err == "urdfkit: warning: r.urdf:4:1: new\n"


def test_many_repairs_of_one_kind_are_one_line_with_their_number(capsys) -> None:
    near = [Suggestion("q")] * 5 + [Suggestion(None)] * 4_995
    repairs = [repair(f"no parent `p{i}`; it is added" + hint, i + 1) for i, hint in enumerate(near)]
    others = [repair(f"no child `c{i}`", i + 1, code="T202") for i in range(9)]
    noted = note_repairs([*repairs, *others])
    first, *rest = capsys.readouterr().err.splitlines()
    assert first == (
        "urdfkit: warning: r.urdf:1:1: no parent `p0`; it is added "
        "(and 4999 more of this kind; `urdfkit lint --target urdfkit` lists them); did you mean `q`?"
    )
    assert rest == [f"urdfkit: warning: r.urdf:{i + 1}:1: no child `c{i}`" for i in range(9)]
    assert len(noted) == 5_009
    note_repairs([*repairs, repair("no parent `new`; it is added", 9)], noted)
    assert capsys.readouterr().err == "urdfkit: warning: r.urdf:9:1: no parent `new`; it is added\n"
