"""Where a source file can be changed, and how: Cosmic Ray's operators, and one of our own that drops a statement.

Knows a file's text. Knows neither its tests nor how they are run. Three kinds of change are left out, because no test
could see them: annotations are never run; a `typing.Protocol` has no code of its own, only the shape of others; and a
direction is 1 or -1, so that to divide by it is to multiply by it.
"""

from __future__ import annotations

import ast
import random
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.operators.operator import Example, Operator
from cosmic_ray.plugins import get_operator, operator_names
from parso.python.tree import Keyword

UNLIKELY = ("ReplaceComparisonOperator_Is", "ReplaceBinaryOperator_BitOr_", "ReplaceUnaryOperator_UAdd")
"""`a > None` for `a is None`, or another operator in `int | None`, is no mistake that a person makes."""
Position = tuple[int, int]
"""Line from 1, column from 0."""


class DropStatement(Operator):  # type: ignore[misc]  # it has no types
    """A call whose value is not used, or an assignment to an attribute, does nothing instead."""

    def mutation_positions(self, node: Any) -> Iterator[tuple[Position, Position]]:
        if node.type != "simple_stmt":
            return
        statement = node.children[0]
        called = statement.type in ("atom_expr", "power") and statement.children[-1].type == "trailer"
        assigned = statement.type == "expr_stmt" and statement.children[0].type in ("atom_expr", "power")
        if called or assigned:
            yield statement.start_pos, statement.end_pos

    @classmethod
    def examples(cls) -> tuple[Example, ...]:
        return (Example("a.b()\n", "pass\n"), Example("a.b = 1\n", "pass\n"))

    def mutate(self, node: Any, _index: int) -> Any:
        first = node.get_first_leaf()
        node.children[0] = Keyword("pass", first.start_pos, first.prefix)
        return node


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change of a file. `was` is the whole line before, without its blanks at both ends: it names the place."""

    line: int
    column: int
    operator: str
    was: str
    now: str
    source: str
    """The changed file."""


def mutants(source: str, sample: int | None, chance: random.Random) -> list[Mutant]:
    """One mutant of each place, by chance one of those that are possible there; of `sample` places at most."""
    lines = source.splitlines()
    skipped, factors = list(_never_run(source)), list(_direction_factors(source))
    changes: dict[Position, list[tuple[str, Any, int]]] = defaultdict(list)
    tree = get_ast(source)
    for name, operator in _operators():
        spans = (span for node in ast_nodes(tree) for span in operator.mutation_positions(node))
        for occurrence, (start, _) in enumerate(spans):
            same = name == "ReplaceBinaryOperator_Mul_Div" and _within(start, factors)
            if not same and not _within(start, skipped):
                changes[start].append((name, operator, occurrence))
    places = sorted(changes)
    if sample is not None and sample < len(places):
        places = sorted(chance.sample(places, sample))
    found = []
    for place in places:
        name, operator, occurrence = chance.choice(changes[place])
        changed = mutate_code(source, operator, occurrence)
        if changed is None or changed == source or not _compiles(changed):
            continue
        new = changed.splitlines()
        at = next((at for at, (a, b) in enumerate(zip(lines, new, strict=False)) if a != b), place[0] - 1)
        found.append(Mutant(place[0], place[1], name, lines[place[0] - 1].strip(), new[at].strip(), changed))
    return found


def _compiles(source: str) -> bool:
    try:
        compile(source, "mutant", "exec", dont_inherit=True)
    except SyntaxError:
        return False
    return True


def _operators() -> Iterator[tuple[str, Any]]:
    for name in operator_names():
        kind, plain = get_operator(name), name.removeprefix("core/")
        if not kind.arguments() and not plain.startswith(UNLIKELY) and not plain.endswith(("_Is", "_IsNot")):
            yield plain, kind()
    for way in ("Is_IsNot", "IsNot_Is"):
        yield f"ReplaceComparisonOperator_{way}", get_operator(f"core/ReplaceComparisonOperator_{way}")()
    yield "DropStatement", DropStatement()


def _within(place: Position, spans: list[tuple[Position, Position]]) -> bool:
    return any(first <= place < last for first, last in spans)


def _never_run(source: str) -> Iterator[tuple[Position, Position]]:
    """What makes no difference: annotations, the shape of a port, and keywords that only forbid what is not done."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.arg(annotation=ast.expr() as said) | ast.AnnAssign(annotation=said):
                pass
            case ast.FunctionDef(returns=ast.expr() as said) | ast.AsyncFunctionDef(returns=ast.expr() as said):
                # The star of keyword arguments is no multiplication.
                yield (node.lineno, node.col_offset), (said.lineno, said.col_offset)
            case ast.ClassDef(bases=[ast.Name(id="Protocol")]):
                yield (node.lineno, node.col_offset), (node.end_lineno or 0, node.end_col_offset or 0)
                continue
            case ast.keyword(arg="strict" | "frozen" | "slots", value=said):
                pass
            case _:
                continue
        yield (said.lineno, said.col_offset), (said.end_lineno or 0, said.end_col_offset or 0)


def _direction_factors(source: str) -> Iterator[tuple[Position, Position]]:
    """Where something is multiplied by a direction: from the end of the one to the beginning of the other."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.BinOp(left=left, op=ast.Mult(), right=ast.Name(id="direction" | "way") as factor):
                yield (left.end_lineno or 0, left.end_col_offset or 0), (factor.lineno, factor.col_offset)
