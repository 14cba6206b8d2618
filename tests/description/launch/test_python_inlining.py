"""Functions of Python launch files are written out where they are called."""

import ast

import pytest

from urdfkit.description.launch.python_constants import launch_reader, parsed
from urdfkit.description.launch.python_inlining import inlined
from urdfkit.description.xml.source import Source

INCLUDE = """
def include(package, name="robot.launch.py", **arguments):
    \"\"\"Include a launch file.\"\"\"
    path = join(share(package), name)
    return Include(path, launch_arguments=arguments.items())
"""


@pytest.mark.parametrize(
    ("text", "written_out"),
    [
        (f"{INCLUDE}\na = include('arm', gui='true')", "a = Include(join(share('arm'), 'robot.launch.py'), "),
        (f"{INCLUDE}\na = include('arm', gui='true')", "launch_arguments={'gui': 'true'}.items())"),
        (f"{INCLUDE}\na = include('arm', name='x.py')", "join(share('arm'), 'x.py'), launch_arguments={}.items())"),
        ("def one(n):\n    return Node(n or 'a')\nb = one(None), one('c')", "b = (Node('a'), Node('c'))"),
        ("def f():\n    def g(x=()):\n        return N(list(x))\n    return [g(), g([1])]\n", "return [N(()), N([1])]"),
        ("def two(n):\n    return one(n + 1)\ndef one(n):\n    return N(n)\na = two(3)", "a = N(3 + 1)"),
        (  # OpaqueFunction calls the function `setup`
            "def one(n):\n    return N(n)\ndef setup(context):\n    return [one(3)]\na = Opaque(function=setup)",
            "return [N(3)]",
        ),
        ("def one(p, *n):\n    return Join([p, *n])\na = one('b', 'c', 'd')", "a = Join(['b', 'c', 'd'])"),
        ("def one(p, *n):\n    return join(p, *n)\na = one('b')", "a = join('b')"),
        ("def f(*n):\n    return N(n)\na = f(1)", "a = N((1,))"),
        ("a = [Node(n) for n in ('x', 'y')]", "a = [Node('x'), Node('y')]"),
        ("def one(p, e=None):\n    return N(p + ([e] if e else []))\na = one([1], {2: 3})", "a = N([1] + [{2: 3}])"),
        ("def one(p, e=None):\n    return N(p + ([e] if e else []))\na = one([1])", "a = N([1] + [])"),
        ("def one(e):\n    return N(e if e else 1)\na = one([])", "a = N(1)"),
        ("def one(e):\n    return N(e if e else 1)\na = one({})", "a = N(1)"),
    ],
)
def test_a_call_is_what_the_function_returns(text: str, written_out: str) -> None:
    result = ast.unparse(inlined(ast.parse(text)))
    assert written_out in result
    assert "def include" not in result
    assert "def one" not in result


@pytest.mark.parametrize(
    "text",
    [
        "def f(n):\n    if n:\n        return N(n)\n    return M(n)\na = f(1)",
        "def f(n):\n    return N(n)\na = f(*names)",
        "def f(n):\n    return N(n)\na = f(1, 2)",
        "def f(n):\n    return N(n)\na = f(m=2)",
        "def f(n):\n    return N(n)\na = f(**arguments)",
        "@cached\ndef f(n):\n    return N(n)\na = f(1)",
        "def f(n):\n    return N(n)\ndef f(n):\n    return M(n)\na = f(1)",
        "def f(n):\n    return N(n)\na = OpaqueFunction(function=f)",
        "a = [N(n) for n in names]",
        "a = [N(n) for n in ('x', 'y') if n]",
        "a = [1] if names else []",
    ],
)
def test_what_depends_on_a_run_stays_as_it_is(text: str) -> None:
    assert ast.unparse(inlined(ast.parse(text))) == ast.unparse(ast.parse(text))


def test_a_computed_part_of_a_sum_of_lists_is_one_item() -> None:
    tree = ast.parse("none = []\na = [1] + none + ([2] if c else [])")
    reader = launch_reader(tree)
    assert [ast.unparse(each) for each in reader.items(ast.Name("a"))] == ["1", "[2] if c else []"]


def test_arguments_keep_their_place() -> None:
    tree = inlined(ast.parse(f"{INCLUDE}\na = include(\n    'arm',\n    gui='true',\n)\n"))
    places = {node.value: node.lineno for node in ast.walk(tree) if isinstance(node, ast.Constant)}
    assert (places["arm"], places["gui"], places["true"]) == (8, 9, 9)


def test_functions_that_call_each_other_or_grow_without_bound_end() -> None:
    inlined(ast.parse("def f(n):\n    return g(n)\ndef g(n):\n    return f(n)\na = f(1)"))
    double = "\n".join(f"def f{i + 1}(n):\n    return f{i}(n), f{i}(n), f{i}(n), f{i}(n), f{i}(n)" for i in range(40))
    tree = inlined(ast.parse(f"def f0(n):\n    return N(n)\n{double}\na = f40([1, 2])"))
    assert sum(1 for _ in ast.walk(tree)) < 100_000


def test_a_file_with_a_very_long_expression_is_still_read() -> None:
    text = "share = '/opt'\nlong = " + " + ".join(["x"] * 2000)
    tree = parsed(Source("a.launch.py", text))
    assert tree is not None
    assert launch_reader(tree).assigned.keys() == {"share", "long"}
