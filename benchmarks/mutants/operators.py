"""Operators that make faults of expressions: sign, comparison, constant, index, boundary, dropped term, swapped argument."""

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_SIGN = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
_BOUNDARY = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
_TURNED = {ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
           ast.Is: ast.IsNot, ast.IsNot: ast.Is}  # fmt: skip
_SAID = (
    "Diagnostic",
    "warn",
    "error",
    "note",
    "print",
    "replace",
    "isinstance",
    "zip",
    "getattr",
    "hasattr",
    "setattr",
)


@dataclass(frozen=True)
class Fault:
    """In function `inside` of `file` (below the root) bytes start to end, `old`, become `new`."""

    file: str
    inside: str
    line: int
    operator: str
    start: int
    end: int
    old: str
    new: str

    @property
    def key(self) -> str:
        """Names it as long as the line stays as it is, wherever it stands."""
        return f"{self.file}:{self.inside}:{self.operator}:{self.old} -> {self.new}"


def faults(root: Path, file: str) -> list[Fault]:
    """All of a module, in the order of their places; none in messages, annotations, defaults of classes and `raise`."""
    raw = (root / file).read_bytes()
    offsets = [0]
    for line in raw.splitlines(keepends=True):
        offsets.append(offsets[-1] + len(line))
    found = []
    for inside, node in _places(ast.parse(raw), ""):
        start = offsets[node.lineno - 1] + node.col_offset
        end = offsets[node.end_lineno - 1] + node.end_col_offset
        for operator, new in _changed(node):
            text = f"({ast.unparse(new)})"
            found.append(Fault(file, inside, node.lineno, operator, start, end, raw[start:end].decode(), text))
    return found


def applied(root: Path, fault: Fault) -> bytes:
    """The module with the fault."""
    raw = (root / fault.file).read_bytes()
    return raw[: fault.start] + fault.new.encode() + raw[fault.end :]


def _places(node: ast.AST, inside: str) -> Iterator[tuple[str, ast.expr]]:
    """Expressions within functions, each with the function's name."""
    if isinstance(node, ast.FunctionDef):
        name = f"{inside}.{node.name}" if inside else node.name
        for part in node.body:
            yield from _within(part, name)
    elif isinstance(node, ast.ClassDef | ast.Module):
        name = f"{inside}.{node.name}" if isinstance(node, ast.ClassDef) and inside else getattr(node, "name", inside)
        for part in node.body:
            yield from _places(part, name)


def _within(node: ast.AST, inside: str) -> Iterator[tuple[str, ast.expr]]:
    if isinstance(node, ast.Raise | ast.JoinedStr | ast.Assert | ast.Import | ast.ImportFrom):
        return
    if isinstance(node, ast.FunctionDef):
        yield from _places(node, inside)
        return
    if isinstance(node, ast.Call) and _name(node.func) in _SAID[:5]:
        return
    if isinstance(node, ast.expr):
        yield inside, node
    for part in ast.iter_child_nodes(node):
        yield from _within(part, inside)


def _name(node: ast.expr) -> str:
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def _changed(node: ast.expr) -> Iterator[tuple[str, ast.expr]]:
    """Operators that fit an expression, and what they make of it."""
    if isinstance(node, ast.BinOp) and not _texts(node):
        if type(node.op) in _SIGN:
            yield "sign", _with(node, op=_SIGN[type(node.op)]())
        if isinstance(node.op, ast.Add | ast.Sub | ast.Mult):
            yield "dropped term", node.left
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) and not isinstance(node.operand, ast.Constant):
        yield "sign", node.operand
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield "comparison", node.operand
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        kind = type(node.ops[0])
        if kind in _BOUNDARY:
            yield "boundary", _with(node, ops=[_BOUNDARY[kind]()])
        if kind in _TURNED:
            yield "comparison", _with(node, ops=[_TURNED[kind]()])
    elif isinstance(node, ast.BoolOp):
        yield "comparison", _with(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())
        yield "dropped term", node.values[0]
    elif isinstance(node, ast.Subscript):
        yield from (("index", _with(node, slice=new)) for new in _moved(node.slice))
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield "constant", ast.Constant(node.value + 1 if type(node.value) is int or not node.value else 2 * node.value)
    elif isinstance(node, ast.Call) and len(node.args) > 1 and _name(node.func) not in _SAID:
        one, other, *more = node.args
        if ast.dump(one) != ast.dump(other) and not any(isinstance(each, ast.Starred) for each in (one, other)):
            yield "swapped argument", _with(node, args=[other, one, *more])


def _moved(index: ast.expr) -> Iterator[ast.expr]:
    if isinstance(index, ast.Slice):
        for part in ("lower", "upper"):
            bound = getattr(index, part)
            if bound is not None and not isinstance(bound, ast.Constant):
                yield _with(index, **{part: ast.BinOp(bound, ast.Add(), ast.Constant(1))})
    elif isinstance(index, ast.UnaryOp) and isinstance(index.operand, ast.Constant):
        yield ast.Constant(0)


def _texts(node: ast.BinOp) -> bool:
    """Whether a sum is one of texts or lists, or an operator of types."""
    return any(isinstance(each, ast.JoinedStr | ast.List | ast.Tuple) or isinstance(getattr(each, "value", None), str)
               for each in (node.left, node.right))  # fmt: skip


def _with(node: ast.AST, **changes: object) -> ast.AST:
    new = copy.copy(node)
    for name, value in changes.items():
        setattr(new, name, value)
    return new
