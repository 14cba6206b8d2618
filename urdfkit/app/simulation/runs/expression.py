"""Expressions of the robot's state with numbers, comparisons and a few functions: ``--until`` and ``--metric``."""

import ast
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from urdfkit.errors import UsageError, did_you_mean
from urdfkit.sim.state.robot_state import State

NAMES = ("t", "x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "wx", "wy", "wz", "contacts", "pi")
"""Time [s], pose of the root link [m, rad], its velocity along the world's axes, the number of contacts."""

FUNCTIONS: dict[str, Callable[..., float]] = {
    "abs": abs,
    "min": min,
    "max": max,
    "hypot": math.hypot,
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
}
"""In addition: ``position('joint')``, ``velocity('joint')`` and ``effort('joint')``."""

JOINT_FUNCTIONS = ("position", "velocity", "effort")

_BINARY: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


def state_values(state: State) -> dict[str, float]:
    """Return the values of `NAMES` in a state, the number of contacts excepted: it is counted on demand."""
    from urdfkit.sim.state.quaternion import to_rpy

    pose, velocity = state.base_pose, state.base_velocity
    return dict(zip(NAMES, (state.t, *pose[:3], *to_rpy(pose[3:]), *velocity, 0.0, math.pi), strict=True))


class Expression:
    """A parsed expression.

    Args:
        text: e.g. ``x > 1 and abs(yaw) < 0.1``, or its syntax tree.
        joints: joints that the expression may name.
        option: name of the option, for messages.
        names: names that the expression may use.

    Raises:
        UsageError: the expression is invalid.
    """

    def __init__(
        self, text: str | ast.expr, joints: Sequence[str], *, option: str = "--until", names: Sequence[str] = NAMES
    ) -> None:
        self.text = text if isinstance(text, str) else ast.unparse(text)
        self._joints, self._option, self._names = joints, option, names
        self._tree = parsed(text, option) if isinstance(text, str) else text
        self._check(self._tree, depth=0)

    def __call__(self, state: State, values: Mapping[str, float]) -> Any:
        """Return the value in a state.

        Args:
            state: for joints and contacts.
            values: values of the names, see `state_values`.

        Raises:
            UsageError: it has no value, such as after a division by zero.
        """
        try:
            return self._value(self._tree, values, state)
        except (ZeroDivisionError, ValueError, OverflowError) as error:
            raise UsageError(f"{self._option}: `{self.text}` at t = {state.t:g} s: {error}") from None

    def _value(self, node: ast.expr, values: Mapping[str, float], state: State) -> Any:
        match node:
            case ast.Constant(value=value):
                return value
            case ast.Name(id="contacts"):
                return len(state.contacts)
            case ast.Name(id=name):
                return values[name]
            case ast.UnaryOp(op=op, operand=operand):
                inner = self._value(operand, values, state)
                return not inner if isinstance(op, ast.Not) else -inner if isinstance(op, ast.USub) else +inner
            case ast.BinOp(left=left, op=op, right=right):
                return _BINARY[type(op)](self._value(left, values, state), self._value(right, values, state))
            case ast.BoolOp(op=op, values=parts):
                found = (self._value(part, values, state) for part in parts)
                return all(found) if isinstance(op, ast.And) else any(found)
            case ast.Compare(left=left, ops=ops, comparators=comparators):
                now = self._value(left, values, state)
                for relation, comparator in zip(ops, comparators, strict=True):
                    following = self._value(comparator, values, state)
                    if not _BINARY[type(relation)](now, following):
                        return False
                    now = following
                return True
            case ast.Call(func=ast.Name(id=name), args=arguments):
                inner = [self._value(argument, values, state) for argument in arguments]
                return getattr(state, name)(*inner) if name in JOINT_FUNCTIONS else FUNCTIONS[name](*inner)
        raise AssertionError(f"unchecked node {node!r}")

    def _check(self, node: ast.expr, *, depth: int) -> None:
        """Reject every node that `_value` does not support.

        Raises:
            UsageError: a node is not allowed.
        """
        if depth > 50:
            self._refuse("the expression is nested too deeply")
        below: list[ast.expr] = []
        match node:
            case ast.Constant(value=bool() | int() | float()):
                pass
            case ast.Name(id=name):
                if name not in self._names:
                    available = ", ".join(self._names)
                    self._refuse(f"unknown name `{name}`{did_you_mean(name, self._names)} (available: {available})")
            case ast.UnaryOp(op=ast.Not() | ast.USub() | ast.UAdd(), operand=operand):
                below = [operand]
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
                below = [left, right]
            case ast.BoolOp(values=parts):
                below = parts
            case ast.Compare(left=left, ops=ops, comparators=comparators) if all(type(op) in _BINARY for op in ops):
                below = [left, *comparators]
            case ast.Call(func=ast.Name(id=name), args=[ast.Constant(value=str(joint))], keywords=[]) if (
                name in JOINT_FUNCTIONS
            ):
                if joint not in self._joints:
                    self._refuse(f"unknown joint `{joint}`{did_you_mean(joint, self._joints)}")
            case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS and arguments:
                below = arguments
            case _:
                self._refuse(f"`{ast.unparse(node)}` is not allowed")
        for inner in below:
            self._check(inner, depth=depth + 1)

    def _refuse(self, reason: str) -> None:
        raise UsageError(f"{self._option}: `{self.text}` cannot be evaluated: {reason}")


def parsed(text: str, option: str) -> ast.expr:
    """Return the syntax tree of an expression.

    Raises:
        UsageError: it is not an expression.
    """
    try:
        return ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise UsageError(f"{option}: `{text}` is not an expression ({getattr(error, 'msg', error)})") from None
