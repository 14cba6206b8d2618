"""Files are read once during a check, and again at the next one."""

from __future__ import annotations

from pathlib import Path

from urdfkit.description.packages import kept_files
from urdfkit.description.packages.kept_files import keeping_results, kept
from urdfkit.description.packages.related_files import neighbours
from urdfkit.lint.project.code_files import node_texts


def test_results_are_kept_within_the_context_only() -> None:
    calls: list[int] = []

    @kept
    def twice(number: int) -> int:
        calls.append(number)
        return 2 * number

    assert [twice(1), twice(1)] == [2, 2]
    assert calls == [1, 1]
    with keeping_results():
        assert [twice(1), twice(2), twice(1)] == [2, 4, 2]
        with keeping_results():
            assert twice(1) == 2
        assert calls == [1, 1, 1, 2]
    with keeping_results():
        assert twice(1) == 2
    assert calls == [1, 1, 1, 2, 1]


def test_texts_are_kept_up_to_a_total_length(monkeypatch) -> None:
    monkeypatch.setattr(kept_files._Results, "left", 10)
    calls: list[int] = []

    @kept
    def text(length: int) -> str:
        calls.append(length)
        return "x" * length

    with keeping_results():
        assert [text(length) for length in (8, 5, 2, 8, 5, 2)] == ["x" * length for length in (8, 5, 2, 8, 5, 2)]
    assert calls == [8, 5, 2, 5]


def test_packages_and_their_code_are_read_again_after_a_check(tmp_path: Path) -> None:
    for name in ("arm", "base"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    package = tmp_path / "arm"
    with keeping_results():
        neighbours(package).clear()
        assert set(neighbours(package)) == {"arm", "base"}
        assert list(node_texts(package)) == []
    (package / "node.py").write_text("import rclpy")
    (tmp_path / "base" / "package.xml").write_text("<package><name>wheels</name></package>")
    with keeping_results():
        assert set(neighbours(package)) == {"arm", "wheels"}
        assert [text for _, text in node_texts(package)] == ["import rclpy"]
