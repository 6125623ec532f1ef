"""Mutants of a file: one small fault each, of kinds that happen when mechanics are written down."""

import ast
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import NamedTuple

_OPERATORS: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
}
_COMPARISONS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
#: characters of an expression by which a number is told
_LONGEST = 60
#: names of functions and fields, each with the one that it is taken for
_TAKEN_FOR = {
    first: second
    for pair in (
        ("min", "max"),
        ("sin", "cos"),
        ("minimum", "maximum"),
        ("argmin", "argmax"),
        ("any", "all"),
        ("real", "imag"),
        ("before", "after"),
        ("lower", "upper"),
        ("force", "moment"),
        ("mass_kg", "angle_deg"),
        ("velocity_m_s", "acceleration_m_s2"),
    )
    for first, second in (pair, pair[::-1])
}


class Mutant(NamedTuple):
    """A file with one fault: where, what was done, the text, the lines of the statement, and what it belongs to.

    No lines of what runs while the module is imported: no test runs that. It belongs to a function, or to a name of the
    module.
    """

    line: int
    fault: str
    text: str
    lines: frozenset[int]
    of: str = ""


def count(source: str) -> int:
    """How many mutants a file has."""
    return sum(1 for _ in _faults(ast.parse(source)))


def names(source: str) -> set[str]:
    """What the mutants of a file are told by: of what they are, and ``of: fault``."""
    tree = ast.parse(source)
    every, every_statement = list(_faults(tree)), statements(tree)
    texts = set()
    for fault in every:
        _, of = statement(every_statement, getattr(fault.node, "lineno", 0))
        old = getattr(fault.node, fault.field)
        texts |= {of, f"{of}: {fault()}"}
        setattr(fault.node, fault.field, old)
    return texts


def mutant(source: str, number: int) -> Mutant:
    """One mutant; what is annotated, documented or said to a reader is no arithmetic and stays."""
    tree = ast.parse(source)
    fault = next(islice(_faults(tree), number, None))
    line = getattr(fault.node, "lineno", 0)
    lines, of = statement(statements(tree), line)
    return Mutant(line, fault(), ast.unparse(ast.fix_missing_locations(tree)), lines, of)


def statements(tree: ast.Module) -> list[ast.stmt]:
    """All of a file, by where they begin."""
    return sorted((node for node in ast.walk(tree) if isinstance(node, ast.stmt)), key=lambda node: node.lineno)


def statement(every: list[ast.stmt], line: int) -> tuple[frozenset[int], str]:
    """Lines of the innermost statement around a line, of one with a body its head; and what it belongs to."""
    around = [stmt for stmt in every if stmt.lineno <= line <= (stmt.end_lineno or 0)]
    functions = [stmt.name for stmt in around if isinstance(stmt, ast.FunctionDef | ast.AsyncFunctionDef)]
    inner = around[-1]
    if not functions:
        of = next((node.id for node in ast.walk(inner) if isinstance(node, ast.Name)), "")
        return frozenset(), of
    body = getattr(inner, "body", None)
    end = body[0].lineno - 1 if body else inner.end_lineno or line
    begin = min([inner.lineno, *(node.lineno for node in getattr(inner, "decorator_list", []))])
    return frozenset(range(begin, max(end, line) + 1)), functions[-1]


def _faults(tree: ast.Module) -> Iterator["_Fault"]:
    around = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}
    for node in _computing(tree):
        if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS and not _of_text(node):
            yield _Fault(node, "op", _OPERATORS[type(node.op)]())
        elif isinstance(node, ast.Compare) and type(node.ops[0]) in _COMPARISONS:
            yield _Fault(node, "ops", [_COMPARISONS[type(node.ops[0])](), *node.ops[1:]])
        elif isinstance(node, ast.BoolOp):
            yield _Fault(node, "op", ast.Or() if isinstance(node.op, ast.And) else ast.And())
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            actual_node = _context(node, around) if isinstance(node.operand, ast.Constant) else node
            yield _Fault(node, "op", ast.UAdd(), actual_node)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            yield _Fault(node, "operand", ast.UnaryOp(ast.Not(), node.operand))
        elif isinstance(node, ast.Name) and node.id in _TAKEN_FOR and isinstance(node.ctx, ast.Load):
            yield _Fault(node, "id", _TAKEN_FOR[node.id])
        elif isinstance(node, ast.Attribute) and node.attr in _TAKEN_FOR and isinstance(node.ctx, ast.Load):
            yield _Fault(node, "attr", _TAKEN_FOR[node.attr], _context(node, around))
        elif (
            isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool)
        ):
            if _left_to_numpy(node, around):
                continue
            value = node.value
            yield _Fault(
                node, "value", value + 1 if isinstance(value, int) else 1.01 * value + 1e-3, _context(node, around)
            )


class _Fault(NamedTuple):
    """A field of a node, what comes in its place, and the expression by which it is told; the node if there is none."""

    node: ast.AST
    field: str
    value: object
    context: ast.AST | None = None

    def __call__(self) -> str:
        node = self.context or self.node
        before = ast.unparse(node)
        setattr(self.node, self.field, self.value)
        return f"{before} -> {ast.unparse(ast.fix_missing_locations(node))}"


def _context(small: ast.AST, around: Mapping[ast.AST, ast.AST]) -> ast.AST:
    """What a number or a field stands in: many of one function are alike, of which one may change nothing."""
    node, home = small, around[small]
    while isinstance(home, ast.Tuple | ast.UnaryOp | ast.Slice | ast.keyword):
        node, home = home, around[home]
    home = home if isinstance(home, ast.expr) else node
    return home if len(ast.unparse(home)) <= _LONGEST else small


def _computing(node: ast.AST) -> Iterator[ast.AST]:
    """Nodes below, without annotations, texts, examples, and arguments of decorators."""
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list") or getattr(node, "arg", None) == "examples":
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not isinstance(child, ast.JoinedStr):
                yield child
                yield from _computing(child)


def _left_to_numpy(node: ast.Constant, around: Mapping[ast.AST, ast.AST]) -> bool:
    """Whether it is the 1 of ``reshape(-1)``: of whatever is below 0 numpy finds the length itself."""
    sign = around[node]
    home = around.get(sign)
    home = around.get(home) if isinstance(home, ast.Tuple) else home
    called = home.func if isinstance(home, ast.Call) else None
    return isinstance(sign, ast.UnaryOp) and isinstance(called, ast.Attribute) and called.attr == "reshape"


def _of_text(node: ast.BinOp) -> bool:
    return any(
        isinstance(side, ast.JoinedStr) or (isinstance(side, ast.Constant) and isinstance(side.value, str))
        for side in (node.left, node.right)
    )
