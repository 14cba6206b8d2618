"""Random xacro files: a grammar of macros, blocks, scopes, lazy properties, YAML, conditions, commands and mistakes."""

from __future__ import annotations

import random
import re
from pathlib import Path
from xml.sax.saxutils import escape

NAMES = ("a", "b", "c", "d", "e1", "pi", "n")
XMLNS = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
FILES = {
    "y.yaml": "k: 5\nl: [1, {z: 2}, [3]]\nnest: {deep: {x: 1}}\nang: !degrees 90\nw: !millimeters 2*pi\n",
    "inc.xacro": f'<r {XMLNS} xmlns:foo="w"><xacro:property name="a" value="${{b}}"/><!-- c -->'
    '<xacro:property name="inc" value="7"/><xacro:macro name="m" params="a:=1"><inc a="${a}" i="${inc}"/></xacro:macro>'
    '<in v="${inc}"/></r>',
    "inc2.xacro": f"<r {XMLNS}><two/>text</r>",
    "sub/two.xacro": f'<r {XMLNS}><xacro:include filename="three.xacro" optional="1"/>'
    "<s v=\"${xacro.abs_filename('q')}\"/></r>",
}
_NUMBERS = ("1", "2", "0", "3.5", "-1", "1e-3", "007", "0x1F", "1_0", ".5", "10")
_TEXTS = ("x", "yy", " z", "true", "1.0", "a b,c;d", "%s", "{:.2f}", "{0}-{x}", "")
_OPERATORS = [*"+-*/%<>", "//", "**", "==", "!=", "and", "or", "in", "is", "not in"]
_FUNCTIONS = [
    "sin",
    "cos",
    "abs",
    "len",
    "str",
    "int",
    "float",
    "bool",
    "round",
    "max",
    "min",
    "sqrt",
    "list",
    "radians",
    "floor",
    "repr",
    "python.abs",
    "python.sum",
    "python.sorted",
    "sorted",
    "math.sqrt",
    "python.type",
    "python.tuple",
    "python.all",
    "python.any",
    "python.zip",
    "sum",
    "set",
    "python.set",
    "hypot",
    "fmod",
    "dict",
    "map",
    "xacro.dotify",
    "dotify",
    "python.hash",
    "isinstance",
    "xacro.tokenize",
    "python.reversed",
    "python.enumerate",
    "python.complex",
]
_ATTRIBUTES = [
    "x",
    "y",
    "items()",
    "upper()",
    "split()",
    "keys()",
    "get('x')",
    "join([str(i)\xa0for\xa0i\xa0in\xa0range(3)])",
    "real",
    "strip()",
    "format(1,x=2)",
    "replace('x','zz')",
    "index(1)",
    "count(1)",
    "values()",
    "is_integer()",
    "nope",
    "y.z",
    "__class__",
    "append(1)",
    "zfill(5)",
]
_YAML = [
    ".k",
    ".l[0]",
    ".l[1].z",
    ".l",
    ".nest.deep",
    ".nest",
    ".ang",
    "[0]",
    ".missing",
    "['nest']",
    ".get('nest').deep",
    ".items()",
    ".l[1:]",
    ".l[1:][0].z",
]
_EXPRESSIONS = (
    "({0})", "-{0}", "not {0}", "{0} if {1} else {2}", "[{0}, {1}]", "({0}, {1})", "dict(x={0}, y={1})", "{0}[0]",
    "{0}[-1]", "{0}['x']", "{0}[0:1]", "{0}[::2]", "[i for i in {0}]", "[i * 2 for i in range(3) if i > {0}]",
    "[str(i) for i in dict(p=1, q={0})]", "sum([i for i in range(3)])", "(lambda v: v + {0})({1})",
    "(lambda v=2: v * {0})()", "list(map(str, {0}))", "list(map(lambda t: t * 2, {0}))", "(w := {0})", "{{{0}: {1}}}",
    "max({0}, {1})", "round({0}, 2)", "{0} % {1}", "'%s %.3f' % ({0}, {1})", "dict([(k, v) for k, v in [('x', {0})]])",
    "{{i: i for i in {0}}}", "sorted({0}, reverse=True)", "max({0}, key=lambda t: -t)", "f'{{{0}!r:>9}}'",
    "xacro.warning('w')", "xacro.arg('r')", "xacro.arg('zz')", "ns.a", "ns.inc", "[x for y in {0} for x in y]",
)  # fmt: skip
_COMMANDS = (
    "$(arg r)", "$(arg s)", "$(eval r*2)", "$(env HOME)", "$(optenv NOPE x y)", "$(cwd)", "${a + $(arg r)}",
    "$(find no)",
    "$(dirname)", "$(eval arg('r'))", "$(eval 1+2)", "$(foo x)", "$(eval 'x' + r)", "$()",
)  # fmt: skip
_LITERALS = (
    "true", "false", "'1'", "'x y'", "text", "a b", "True", "", "  ", "$${a}", "$$(x)", "$", "a$b", "50%", "&lt;x&gt;",
    "é", "${", "$$$", "''", "'",
)  # fmt: skip
_PARAMETERS = (
    "a", "b", "*blk", "**blks", "a:=1", "b:=${c}", "c:=^", "d:=^|5", "x:='q r'", "n:=${1 + 2}", "a=2", "e1:=^|${a}",
    "y:= 3", "z:=", "*other", "b:=$(arg r)", "q:=&quot;x&quot;",
)  # fmt: skip
_OPTIONS = ("", 'ns="ns"', 'optional="true"')
_COMMENTS = ("<!-- c -->", "<!-- ${a} -->", "<!-- xacro:eval-comments -->", "<!-- xacro:eval-comments:off -->")
_TAG = re.compile(
    r"<!--.*?-->|<!\[CDATA.*?\]\]>|<\?.*?\?>|<(/?)([\w:.]+)((?:\"[^\"]*\"|[^>\"])*?)(/?)>|[^<]+", re.DOTALL
)


_MACROS = (
    "",
    """<xacro:macro name="m" params="a b:=2 *blk">\n <x a="${a}"/><xacro:insert_block name="blk"/>\n</m>
<xacro:m a="1"><o/></m>""",
    """<xacro:macro name="k" params="a:=^|3 **blks"><x a="${a}"><xacro:insert_block name="blks"/></x>\n</m>
<xacro:k a="1"><o>1</o></k>""",
)


class Grammar:
    """Writes random parts of xacro files.

    Args:
        seed: of its random numbers.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def document(self, kept: str, added: str) -> str:
        """Return a file of two parts, with the right end tags."""
        parts, open_tags = [], []
        text = f'<robot {XMLNS} name="t">{kept}{self._space()}{added}{self._space()}</robot>'
        for match in _TAG.finditer(text):
            part = match[0]
            if match[2] and match[1]:
                part = f"</{open_tags.pop()}>"
            elif match[2] and not match[4]:
                open_tags.append(match[2])
            parts.append(part)
        return "".join(parts)

    def head(self) -> str:
        """Return the beginning of a file: properties, and perhaps macros and an include."""
        pick = self._random.choice
        names = self._random.sample(NAMES, self._random.randint(2, 7))
        properties = "".join(f'<xacro:property name="{name}" value="{self.value()}"/>{self._space()}' for name in names)
        macro = pick(_MACROS)
        include = pick(("", '<xacro:include filename="inc.xacro" ns="ns"/>'))
        return f'<xacro:arg name="r" default="3"/>\n{properties}{macro}{include}'

    def value(self) -> str:
        """Return the value of an attribute."""
        chance, pick = self._random.random(), self._random.choice
        if chance < 0.35:
            return pick(_NUMBERS)
        if chance < 0.5:
            return pick(_LITERALS)
        if chance < 0.85:
            return f"${{{self._quoted()}}}"
        return f"x${{{self._quoted()}}} ${{{pick(NAMES)}}}" if chance < 0.92 else pick(_COMMANDS)

    def _quoted(self) -> str:
        return escape(self.expression(), {'"': "&quot;"})

    def expression(self, depth: int = 0) -> str:
        """Return an expression."""
        chance, pick = self._random.random(), self._random.choice
        if depth > 3 or chance < 0.25:
            return pick(NAMES)
        if chance < 0.4:
            return pick(_NUMBERS)
        if chance < 0.47:
            return f"'{pick(_TEXTS)}'"
        below = [self.expression(depth + 1) for _ in range(3)]
        if chance < 0.6:
            return f"{below[0]} {pick(_OPERATORS)} {below[1]}"
        if chance < 0.7:
            return f"{pick(_FUNCTIONS)}({below[0]})"
        if chance < 0.77:
            return f"{below[0]}.{pick(_ATTRIBUTES)}"
        if chance < 0.8:
            return f"xacro.load_yaml('y.yaml'){pick(_YAML)}"
        return str(pick(_EXPRESSIONS)).format(*below)

    def _space(self) -> str:
        return self._random.choice(("", "\n", "\n  ", "\n\n", " "))

    def _nodes(self, depth: int, in_macro: bool = False) -> str:
        count = self._random.randint(0, 4)
        return "".join(self._space() + self.node(depth + 1, in_macro) for _ in range(count)) + self._space()

    def node(self, depth: int = 0, in_macro: bool = False) -> str:
        """Return an element, text or comment; end tags have any name."""
        chance, pick, value = self._random.random(), self._random.choice, self.value
        if depth > 5:
            return f'<l v="{value()}"/>'
        if chance < 0.2:
            return self._property()
        if chance < 0.24:
            return f'<xacro:property name="{pick(("blk", "blks", "other", "a"))}">{self._nodes(depth)}</p>'
        if chance < 0.36:
            name = pick(("m", "k", "q", "m", "xacro:m", "n.m", "call", "link"))
            params = " ".join(self._random.choices(_PARAMETERS, k=self._random.randint(0, 3)))
            more = pick(("", ' xmlns:foo="u"', ' xmlns:foo="v"'))
            return f'<xacro:macro name="{name}" params="{params}"{more}>{self._nodes(depth, in_macro=True)}</m>'
        if chance < 0.52:
            return self._call(depth)
        if chance < 0.62:
            condition = pick(("true", "false", "1", "0", "$(arg r)", "2", "x", "1.0", "${a == 1}", "${b}", value()))
            return f'<xacro:{pick(("if", "unless"))} value="{condition}">{self._nodes(depth)}</i>'
        if chance < 0.66:
            is_used = in_macro or self._random.random() < 0.3
            return f'<xacro:insert_block name="{pick(("blk", "blks", "other", "a"))}"/>' if is_used else "t"
        if chance < 0.69:
            return str(pick(_COMMENTS))
        if chance < 0.72:
            return f'<xacro:attribute name="{pick(("at", "${a}", "x:y"))}" value="{value()}"/>'
        if chance < 0.74:
            name = pick(("el", "${c}", "xacro:m", "e${a}"))
            return f'<xacro:element xacro:name="{name}" k="{value()}">{self._nodes(depth)}</e>'
        if chance < 0.77:
            return f'<xacro:arg name="{pick(("r", "s", "t"))}" default="{value()}"/>'
        if chance < 0.8:
            file = pick(
                ("inc.xacro", "inc.xacro", "no.xacro", "inc*.xacro", "zz*.xacro", "sub/two.xacro", "${a}.xacro")
            )
            return f'<xacro:include filename="{file}" {pick(_OPTIONS)}/>'
        if chance < 0.84:
            return value()
        if chance < 0.85:
            return pick(("<![CDATA[x ${a}]]>", "<?pi d?>"))
        attributes = pick(
            ("", f'name="{value()}"', f'b="{value()}" a="{value()}"', 'xacro:z="1"', 'xmlns:foo="u"', 'xmlns:foo="v"')
        )
        return f"<{pick(('link', 'j', 'origin'))} {attributes}>{pick(('', self._nodes(depth, in_macro), value()))}</x>"

    def _property(self) -> str:
        pick, value = self._random.choice, self.value()
        rest = pick(
            (
                *[f'value="{value}"'] * 4,
                f'default="{value}"',
                'remove="true"',
                f'value="{value}" scope="{pick(("global", "parent", "x"))}"',
                f'value="{value}" lazy_eval="{pick(("false", "0", "true"))}"',
                'value="1" default="2"',
                'foo="1" value="2"',
            )
        )
        return f'<xacro:property name="{pick((*NAMES, "if", "x-y", "${a}", "__q", "p"))}" {rest}/>'

    def _call(self, depth: int) -> str:
        pick = self._random.choice
        name = pick(("m", "k", "q", "m", "ns.m", "none"))
        names = self._random.sample(("a", "b", "c", "d", "x", "y"), pick((0, 0, 1, 1, 2)))
        attributes = " ".join(f'{given}="{self.value()}"' for given in names)
        content = pick(("", "", self._nodes(depth)))
        if self._random.random() < 0.15:
            computed = pick((name, f"${{'{name}'}}", ""))
            return f'<xacro:call macro="{computed}" {attributes}>{content}</c>'
        return f"<xacro:{name} {attributes}>{content}</c>"


def write_files(folder: Path) -> None:
    """Write the files that random files include and load."""
    for name, text in FILES.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
