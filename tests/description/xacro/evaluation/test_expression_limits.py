"""Expressions and macros that would go on until the memory is full are refused before they begin."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.xacro.expand import expand, expand_leniently
from urdfkit.errors import XacroError

Write = Callable[[str, str], Path]

GROWING = [
    "9**9**9",
    "'x' * 3 * 10**9",
    "list(range(10**9))",
    "[0] * 10**10",
    "python.sum(python.range(10**12))",
    "[i * j for i in range(10**5) for j in range(10**5)]",
    "python.any(False for i in range(9999) for j in range(9999))",
    "'%099999999d' % 1",
    "'%*d' % (10**9, 1)",
    "'x'.ljust(10**10)",
    "str.ljust('x', 10**10)",
    "list(map('x'.ljust, [10**9]))",
    "factorial(10**7)",
    "math.comb(10**7, 5 * 10**6)",
    "math.prod([10**1000] * 99999)",
    "1 &lt;&lt; 10**9",
    "round(5, -10**9)",
    "','.join(['x' * 9999] * 999)",
    "('x' * 9999).replace('x', 'y' * 99)",
    "('\\t' * 99).expandtabs(10**8)",
    "(5).to_bytes(10**10, 'big')",
    "python.type('x'.encode())(10**10)",
    "list(map(list, map(range, [99999] * 99999)))",
    "(lambda f: f(f))(lambda f: f(f) + f(f))",
    "(lambda f: f(f, 50))(lambda f, n: 1 if n == 0 else f(f, n - 1) + f(f, n - 1))",
    "str([[[[0] * 99] * 99] * 99])",
    "[x.extend(x) for x in [[1]] for i in range(99)]",
    "[g.append([g.pop()]) for g in [[1]] for i in range(999)]",
    "[(g := (x for x in g)) for g in [[1]] for i in range(9999)]",
    "[a == b for a in [[0] * 9999] for b in [[0] * 9999] for i in range(9999)]",
    "1.5 in range(10**12)",
    "[*range(99999), *range(99999)]",
    "python.sum([[0] * 9999] * 99, [])",
    "python.type('A', (), {})",
    "xacro.tokenize('x' * 9999, 'a](x+x+)+y[')",
    "xacro.tokenize('a' + 'x' * 50, 'a](x+x+)+y[b')",
    "-" * 5000 + "1",
    "(" * 3000 + "1" + ")" * 3000,
    "1+" * 4000 + "1",
    "1+" * 9000 + "1",
]


@pytest.mark.slow
@pytest.mark.parametrize("expression", GROWING)
def test_what_grows_is_refused(write: Write, expression: str) -> None:
    path = write("m.xacro", f'HEAD<link name="${{{expression}}}"/></robot>')
    with pytest.raises(XacroError) as caught:
        expand(path)
    assert "\n" not in str(caught.value)
    (fault,) = expand_leniently(path).faults
    assert fault.kind in ("too-large", "bad-expression")


@pytest.mark.parametrize(
    ("expression", "what"),
    [
        ("9**9**9", "`${9**9**9}` is too large: it creates an integer of more than 10,000 bits"),
        ("[0] * 10**10", "it creates lists of more than 100,000 elements in total"),
        ("'x' * 10**10", "it creates a string of more than 100,000 characters"),
        ("1+" * 9000 + "1", "it has 18,001 characters; at most 10,000 are evaluated"),
        ("[0 for i in range(9999) for j in range(9999)]", "exceed 1,000,000 steps"),
    ],
)
def test_the_message_says_what_is_too_large_and_the_limit(write: Write, expression: str, what: str) -> None:
    with pytest.raises(XacroError) as caught:
        expand(write("m.xacro", f'HEAD\n <link name="${{{expression}}}"/></robot>'))
    assert what in str(caught.value)
    assert str(caught.value).startswith("m.xacro:2:2: ")


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("[2 * x for x in range(3)]", "[0, 2, 4]"),
        ("[x * y for x in [1, 2] for y in [3, 4] if x != y]", "[3, 4, 6, 8]"),
        ("'%.3f' % pi", "3.142"),
        ("'%s_%02d' % ('a', 7)", "a_07"),
        ("' '.join(map(str, [1, 2]))", "1 2"),
        ("'ab' * 2 + 'c'", "ababc"),
        ("2**10 - 3 % 2", "1023"),
        ("1 &lt;&lt; 4 | 3", "19"),
        ("sorted([3, 1, 2], key=lambda x: -x)", "[3, 2, 1]"),
        ("list(map(lambda x: x + 1, [1]))[0]", "2"),
        ("dict(a=1)['a'] + dict([('b', 2)])['b']", "3"),
        ("max([1, 2], key=python.abs)", "2"),
        ("python.sum([[1], [2]], [])", "[1, 2]"),
        ("math.prod([2, 3])", "6"),
        ("1 &lt; 2 &lt; 3", "True"),
        ("'a' in 'cab' and 1 in [1]", "True"),
        ("[1, 2, 3][1:]", "[2, 3]"),
        ("round(2.5678, 2)", "2.57"),
        ("python.isinstance([], list)", "True"),
        ("(y := 3) + 1", "4"),
        ("'a-b'.replace('-', '_').upper()", "A_B"),
        ("list(python.zip([1], *[[2]]))", "[(1, 2)]"),
        ("{1: 'a'}[1] if True else None", "a"),
    ],
)
def test_what_people_write_is_as_in_python(write: Write, expression: str, value: str) -> None:
    expression = expression.replace("}", "}")
    if "}" in expression:
        expression = expression.replace("{1: 'a'}", "dict([(1, 'a')])")
    root = expand(write("m.xacro", f'HEAD<link name="${{{expression}}}"/></robot>')).root
    assert root is not None
    assert root.children[0].get("name") == value


def test_a_command_is_bounded_too(write: Write) -> None:
    for command in ("9**9**9", "[0] * 10**10", "f'{1:>9999999999}'"):
        with pytest.raises(XacroError, match="too large"):
            expand(write("m.xacro", f'HEAD<link name="$(eval {command})"/></robot>'))


def test_properties_that_laugh_are_stopped(write: Write) -> None:
    lines = "".join(f'<xacro:property name="p{i + 1}" value="{f"${{p{i}}}" * 10}"/>' for i in range(12))
    path = write("m.xacro", f'HEAD<xacro:property name="p0" value="lol"/>{lines}<link name="${{p12}}"/></robot>')
    with pytest.raises(XacroError, match="it creates a string of more than 100,000 characters"):
        expand(path)
    assert [fault.kind for fault in expand_leniently(path).faults] == ["too-large"]


def test_properties_that_square_are_stopped(write: Write) -> None:
    lines = "".join(f'<xacro:property name="p{i + 1}" value="${{p{i} * p{i}}}"/>' for i in range(40))
    path = write("m.xacro", f'HEAD<xacro:property name="p0" value="99"/>{lines}<link name="${{p40}}"/></robot>')
    assert [fault.kind for fault in expand_leniently(path).faults] == ["too-large"]


@pytest.mark.slow
def test_blocks_that_multiply_are_stopped_where_they_are_inserted(write: Write) -> None:
    block = '<xacro:property name="b{}">{}</xacro:property>'
    lines = "".join(block.format(i + 1, f'<xacro:insert_block name="b{i}"/>' * 30) for i in range(8))
    path = write(
        "m.xacro",
        f'HEAD{block.format(0, "<link/>")}{lines}\n<xacro:insert_block name="b8"/><link name="left"/></robot>',
    )
    with pytest.raises(XacroError, match="check for nested calls"):
        expand(path)
    expanded = expand_leniently(path)
    assert [(fault.kind, fault.position.line) for fault in expanded.faults] == [("too-many", 2)]
    assert expanded.root is not None
    assert [child.get("name") for child in expanded.root.children] == ["left"]


def test_macros_that_multiply_leave_the_rest(write: Write) -> None:
    levels = "".join(f'<xacro:macro name="m{i + 1}">{f"<xacro:m{i}/>" * 30}</xacro:macro>' for i in range(8))
    path = write("m.xacro", f'HEAD<xacro:macro name="m0"/>{levels}\n<xacro:m8/><link name="left"/></robot>')
    expanded = expand_leniently(path)
    assert [(fault.kind, fault.position.line) for fault in expanded.faults] == [("too-many", 2)]
    assert expanded.root is not None
    assert [child.get("name") for child in expanded.root.children] == ["left"]


def test_includes_that_multiply_are_stopped(write: Write) -> None:
    for i in range(12):
        write(f"i{i + 1}.xacro", f"HEAD{f'<xacro:include filename={chr(39)}i{i}.xacro{chr(39)}/>' * 2}</robot>")
    write("i0.xacro", "HEAD</robot>")
    assert {fault.kind for fault in expand_leniently("i12.xacro").faults} == {"too-many"}


def test_a_file_without_end_is_not_loaded(write: Write) -> None:
    path = write("m.xacro", "HEAD<link name=\"${xacro.load_yaml('/dev/zero')}\"/></robot>")
    (fault,) = expand_leniently(path).faults
    assert fault.message.endswith("/dev/zero is not a regular file")


@pytest.mark.parametrize(
    ("expression", "most"),
    [
        ("len('x' * N)", 100_000),
        ("len('x' * 9 + 'x' * (N - 9))", 100_000),
        ("len('x'.ljust(N))", 100_000),
        ("len('x'.zfill(N))", 100_000),
        ("len('\\t'.expandtabs(N))", 99_999),  # the tab itself counts
        ("len('\\t'.expandtabs(tabsize=N))", 99_999),
        ("len('x'.replace('x', 'y' * N))", 99_999),
        ("len(','.join(['x', 'y' * N]))", 99_997),  # one separator too many counts
        ("len('a'.translate(dict([[97, 'x' * N]])))", 100_000),
        ("len(list(range(N)))", 99_999),
        ("1 &lt;&lt; (N - 1) > 0", 10_000),
    ],
)
def test_the_largest_value_is_allowed_and_a_larger_one_refused(write: Write, expression: str, most: int) -> None:
    """The list of a range counts as one of its own elements."""

    def expanded(size: int) -> str:
        return expand(write("m.xacro", f'HEAD<link name="${{{expression.replace("N", str(size))}}}"/></robot>')).xml

    assert "<link" in expanded(most)
    with pytest.raises(XacroError, match="more than"):
        expanded(most + 1)
