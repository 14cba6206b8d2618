"""What expressions cannot reach: every attempt is refused at its place, and none returns an object of Python."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import quoteattr

import pytest

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.evaluation.evaluator import Evaluator
from urdfkit.errors import XacroError

Write = Callable[[str, str], Path]

_OWNERS = (
    "()", "''", "[]", "{}", "1", "1.0", "1j", "b''", "None", "True", "...", "str", "len", "sin", "python", "xacro",
    "math",
    "xacro.load_yaml", "python.type", "python.type(1)", "(lambda: 1)", "''.upper", "[].append", "str.upper",
    "(x for x in [1])", "map(str, [1])", "python.slice(1)", "range(3)", "python.set()", "python.zip([1])",
    "xacro.dotify(dict(a=1))", "python.frozenset()", "dict", "max",
)  # fmt: skip
_NAMES = (
    "__class__",
    "__dict__",
    "__init__",
    "__globals__",
    "__self__",
    "__getattribute__",
    "__subclasses__",
    "__doc__",
)
_PLAIN_NAMES = ("call", "kind", "name", "bound", "values_of", "gi_frame", "gi_code", "f_globals", "func_globals", "mro")

DUNDER = [f"{owner}.{name}" for owner in _OWNERS for name in _NAMES]
PRIVATE = [f"{owner}.{name}" for owner in _OWNERS for name in _PLAIN_NAMES]
OTHERS = [
    "'{0.__class__}'.format(1)",
    "'{0[__class__]}'.format(1)",
    "'{x.__class__}'.format(x=1)",
    "'{0.real}'.format(1)",
    "'{0[0]}'.format([1])",
    "'{:{0.__class__}}'.format(1)",
    "str.format('{0.__class__}', 1)",
    "list(map(str.format, ['{0.__class__}'], [1]))",
    "list(map('{0.__globals__}'.format, [xacro.load_yaml]))",
    "'{x.call}'.format_map(dict(x=xacro.load_yaml))",
    "'{0[}].__globals__[os].environ}'.format(dict([('}', xacro.load_yaml)]))",
    "'{0[\\x7d].__globals__[os].environ\\x7d'.format(dict([('\\x7d', xacro.load_yaml)]))",
    "f'{(1).__class__}'",
    "f'{1!x}'",
    "'%(__class__)s' % 1",
    "[x.__class__ for x in [1]]",
    "{x.__class__ for x in [1]}",
    "{1: x.__class__ for x in [1]}",
    "list(x.__class__ for x in [1])",
    "(lambda: ().__class__.__bases__[0].__subclasses__())()",
    "(lambda x: x.__class__)(1)",
    "(lambda __x: __x)(1)",
    "(lambda *a: a)(1)",
    "(lambda **a: a)(x=1)",
    "(__x := 1)",
    "[__x for __x in [1]]",
    "().__class__",
    "()._＿class_＿",
    "().﹍﹍class﹍﹍",
    "＿＿import＿＿('os')",
    "__import__('os')",
    "__builtins__",
    "__name__",
    "__debug__",
    "__file__",
    "open('/etc/passwd')",
    "eval('1')",
    "exec('1')",
    "compile('1', '', 'eval')",
    "getattr(1, 'real')",
    "setattr(1, 'real', 2)",
    "hasattr(1, 'real')",
    "delattr(1, 'real')",
    "globals()",
    "locals()",
    "dir()",
    "id(1)",
    "input()",
    "breakpoint()",
    "print(1)",
    "object()",
    "super()",
    "classmethod(1)",
    "property(1)",
    "staticmethod(1)",
    "memoryview(b'')",
    "bytearray(b'')",
    "iter([1])",
    "next([1])",
    "callable(1)",
    "help()",
    "exit()",
    "quit()",
    "license",
    "copyright",
    "os",
    "sys",
    "os.environ",
    "sys.modules",
    "python.vars()",
    "python.vars(python.type)",
    "python.vars(xacro)",
    "python.getattr(1, 'real')",
    "python.eval('1')",
    "python.open('x')",
    "python.object",
    "python.super",
    "python.type('A', (), {})",
    "python.type(python.type)('A', (), {})",
    "python.type(python.type(1))('A', (), {})",
    "python.type(None)()",
    "python.type(len)('f', 1)",
    "python.type(lambda: 1)(1, {})",
    "python.type(str.upper)()",
    "python.type(x for x in [1])()",
    "python.type(...)()",
    "math.__loader__",
    "math.__spec__.loader",
    "xacro.load_yaml.__globals__",
    "xacro.os",
    "xacro.sys",
    "xacro.parent.parent",
    "math.root",
    "math.values['x']",
    "math.host",
    "python.pending",
    "yield 1",
    "await 1",
    "(yield)",
    "lambda: (yield)",
    "[await x for x in [1]]",
    "[x async for x in [1]]",
    "[x.a for x.a in [1]]",
    "[x for x[0] in [[1]]]",
    "x = 1",
    "import os",
    "del x",
    "1; 2",
    "xacro.dotify(dict(a=1)).__class__",
    "xacro.dotify(dict(a=len)).a.__self__",
    "xacro.dotify(dict([('__class__', 1)])).__class__",
    "sorted([1], key=len.__call__)",
    "max([1], key=python.getattr)",
    "python.isinstance(1, python.object)",
    "''.join.__self__",
    "dict.fromkeys.__self__",
    "xacro.tokenize('a', 'a](x+x+)+y[')",
    "python.hash.__module__",
    "''.encode().__class__",
    "'a'.translate({97: ().__class__})",
    "1 .__class__",
    "(1).real.__class__",
    "[1][().__class__]",
    "not ().__class__",
    "-().__class__",
    "1 if ().__class__ else 2",
    "{**().__dict__}",
    "[*().__dict__]",
    "len(*().__dict__)",
    "dict(**().__dict__)",
    "1 < ().__class__",
]


@pytest.mark.parametrize("expressions", [DUNDER, PRIVATE, OTHERS], ids=["dunder", "private", "others"])
def test_an_escape_is_refused_at_its_place(write: Write, expressions: list[str]) -> None:
    for expression in expressions:
        before, _, after = expression.partition("}")
        if after or "}" in expression:
            expression = expression.replace("}", "' + xacro.brace + '") if "'" in expression else before + after
        path = write("m.xacro", f"HEAD\n  <link name={quoteattr('${' + expression + '}')}/></robot>")
        with pytest.raises(XacroError) as caught:
            pytest.fail(f"{expression} gives {Evaluator(str(path), {}, Packages(near=path)).expand()}")
        position = caught.value.position
        assert position is not None, expression
        assert (position.line, position.column) == (2, 3), expression


@pytest.mark.parametrize(
    "command",
    ["open", "__builtins__", "getattr", "compile", "vars", "[x.gi_frame for x in [1]]", "eval", "x.__class__", "os"],
)
def test_a_command_is_as_safe_as_an_expression(write: Write, command: str) -> None:
    path = write("m.xacro", f'HEAD\n  <link name="$(eval {command})"/></robot>')
    with pytest.raises(XacroError):
        Evaluator(str(path), {}, Packages(near=path)).expand()
