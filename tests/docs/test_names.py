"""Names of code and of its tests are nouns of the field: no participle, and no pronoun (docs/style.md)."""

import ast
import re
from collections.abc import Iterator
from functools import cache

import pytest

from tests.docs.reading import ROOT

WORDS = frozenset(
    ("asked", "told", "said", "found", "given", "heard", "liked", "looked", "kept", "known", "one", "each")
)
FOLDERS = ("deploy", "docs", "examples", "optimizer", "schemas", "service", "tests")
#: more of production code; the examples stand alone, and tests wait for theirs
MORE = frozenset(
    {
        "added", "both", "bracketed", "chosen", "counted", "done", "drawn", "held", "hinted", "joined",
        "listed", "made", "merged", "moved", "named", "ordered", "others", "packed", "posed", "pressed", "seen",
        "settled", "shown", "some", "sought", "such", "taken", "these", "this", "those", "tried", "turned",
        "wanted", "what", "which", "wrapped",
    }
)  # fmt: skip
WORDS_ALONE = ("examples/", "tests/")
#: names that others depend on, which therefore stay; each with the file that has it
CONTRACT = {
    # fields of answers
    ("schemas/request/accuracy.py", "limits_kept"),
    ("schemas/request/rounding.py", "limits_kept"),
    # a schema of openapi.json, by which generated clients call their type
    ("schemas/machine/fitted.py", "GivenCounterweight"),
    # settings, as variables of the environment name them
    ("service/settings.py", "max_connections_each"),
    ("service/settings.py", "queue_length_each"),
    ("service/settings.py", "held_mb_each"),
    ("service/settings.py", "event_streams_each"),
    ("service/settings.py", "row_streams_each"),
    ("service/settings.py", "max_jobs_each"),
    # a column of the database of jobs, whose rows become these attributes
    ("service/jobs/job.py", "kept"),
    # fields of answers, and of rows
    ("schemas/match/answer.py", "objective_as_listed"),
    ("schemas/request/accuracy.py", "as_drawn_error"),
    ("optimizer/studies/accuracy/measure.py", "as_drawn_error"),
    ("schemas/sweep/answers.py", "done"),
    # columns of the database of jobs, and a label of a metric
    ("service/jobs/job.py", "done"),
    ("service/workers/pool.py", "moved_long"),
    # settings, and what a protocol of asyncio is called with
    ("service/settings.py", "held_mb"),
    ("service/wire/connections.py", "connection_made"),
    # properties in documents that FreeCAD has saved
    ("examples/freecad/Counterweight/freecad/counterweight/balance.py", "AskedUnbalance"),
    ("examples/freecad/Counterweight/freecad/counterweight/balance.py", "AskedAngle"),
    ("tests/freecad/inside/files.py", "AskedAngle"),
    ("tests/freecad/inside/ways.py", "AskedAngle"),
    # a field of a route that only tests have
    ("tests/service/toy.py", "one"),
    # the file of the cases that searches add
    ("tests/hard/cases/found.py", "found"),
}


@cache
def is_noun(name: str, words: frozenset[str] = WORDS) -> bool:
    """Whether no part of a name is one of the words: parts stand between underscores, or begin with a capital."""
    parts = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+", name)
    return words.isdisjoint(part.lower() for part in parts)


def names(tree: ast.AST) -> Iterator[str]:
    """Classes, functions, their parameters, variables, fields of classes and attributes of objects."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            yield node.name
            targets = [part.target for part in node.body if isinstance(part, ast.AnnAssign)]
            targets += [target for part in node.body if isinstance(part, ast.Assign) for target in part.targets]
            yield from (target.id for target in targets if isinstance(target, ast.Name))
        # the name of a test is a sentence
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            if not node.name.startswith("test_"):
                yield node.name
        elif isinstance(node, ast.arg):
            yield node.arg
        # in capitals one is a number, and both is a value
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield re.sub("_?(ONE|BOTH)(?![A-Z])", "", node.id) if node.id.isupper() else node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr


def no_nouns() -> set[tuple[str, str]]:
    """File and name, or file and its own name."""
    results = set()
    files = [file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*.py"))]
    assert len(files) > 1400
    for file in files:
        place = file.relative_to(ROOT).as_posix()
        words = WORDS if place.startswith(WORDS_ALONE) else WORDS | MORE
        every = {*names(ast.parse(file.read_text()))} | ({file.stem} if not file.stem.startswith("test_") else set())
        results |= {(place, name) for name in every if not is_noun(name, words)}
    return results


def test_code_is_named_by_nouns() -> None:
    left = no_nouns()
    assert left - CONTRACT == set(), "name the thing by its type or its role, as docs/style.md says"
    assert CONTRACT - left == set(), "these are gone: take them from the list"


@pytest.mark.parametrize(
    "text",
    [
        "class Found: ...",
        "class Part:\n    limit_kept: int",
        "class Part:\n    one = 1",
        "def told(): ...",
        "def area(*, given_mm): ...",
        "def area(*each): ...",
        "async def area(**asked): ...",
        "area = lambda one: one",
        "def area(part):\n    part._known = 1",
        "def area(parts):\n    return [2 * one for one in parts]",
        "each = 1",
        "ASKED = 1",
    ],
)
def test_a_participle_is_seen_wherever_it_stands(text: str) -> None:
    assert [name for name in names(ast.parse(text)) if not is_noun(name)] != []


def test_a_word_within_a_word_is_no_participle() -> None:
    assert all(map(is_noun, ("", "foundation_loads", "Tone", "zones", "teach", "stone_m", "_beaches")))
