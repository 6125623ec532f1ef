"""Which tests are to notice a fault, and in which order they run."""

import ast
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from tests.mutation.mutants import Mutant, statement, statements

#: tests that are chosen at most
_CHOSEN = 400
#: seconds of a short test: those of all files run first
_SHORT_S = 0.3

#: lines by file
Lines = Mapping[str, frozenset[int]]


class Trial(NamedTuple):
    """A test, its seconds, the lines that it runs of each file, and those that run for all tests of its file."""

    name: str
    seconds: float
    lines: Lines
    shared: Lines = MappingProxyType({})

    @property
    def file(self) -> str:
        """Of tests."""
        return self.name.partition("::")[0]

    def runs(self, places: Lines) -> bool:
        """Whether it runs one of some lines itself."""
        return _meet(self.lines, places)


def places(mutant: Mutant, file: Path, texts: Mapping[Path, str]) -> Lines:
    """Lines of a fault; of one in a name of a module, those of a room that use it, or what is made of it."""
    if mutant.lines:
        return {str(file): mutant.lines}
    names = _derivatives(mutant.of, ast.parse(texts[file]))
    used: dict[str, frozenset[int]] = {}
    for path, text in texts.items():
        tree = ast.parse(text)
        every = statements(tree)
        lines = [statement(every, node.lineno)[0] for node in ast.walk(tree) if _name(node) in names]
        used[str(path)] = frozenset().union(*lines)
    return {name: lines for name, lines in used.items() if lines} or {str(file): frozenset()}


def chosen(trials: list[Trial], used: Lines, limit_s: float) -> list[str]:
    """Tests that run some lines, then other tests of their files, which may look at what was computed before them.

    Of a file the shortest come first, and every file has its turn: tests of one file look at the same. Of what is used
    nobody knows where, such as a table, they are any tests: those first that run its file.

    Parameters
    ----------
    limit_s : seconds that all of them take together, s; a single one may take longer.
    """
    own = [trial for trial in trials if trial.runs(used)]
    files = {trial.file for trial in own} | {trial.file for trial in trials if _meet(trial.shared, used)}
    beside = [trial for trial in trials if trial.file in files and not trial.runs(used)]
    if not any(used.values()):
        beside = sorted(trials, key=lambda trial: used.keys().isdisjoint(trial.lines))
    few: list[Trial] = []
    seconds = 0.0
    for single_trial in (*_in_turn(own), *(_in_turn(beside) if any(used.values()) else beside)):
        seconds += single_trial.seconds
        if few and (seconds > limit_s or len(few) == _CHOSEN):
            break
        few.append(single_trial)
    return [trial.name for trial in _in_order(few)]


def _meet(lines: Lines, places: Lines) -> bool:
    return any(not lines.get(name, frozenset()).isdisjoint(place) for name, place in places.items())


def _in_turn(trials: list[Trial]) -> list[Trial]:
    """The shortest first, each the later the more of its file come before it."""
    before: dict[str, int] = defaultdict(int)
    late = []
    for trial in sorted(trials, key=lambda single_trial: single_trial.seconds):
        before[trial.file] += 1
        late.append((trial.seconds * before[trial.file], trial))
    return [late_trial for _, late_trial in sorted(late, key=lambda pair: pair[0])]


def _in_order(trials: list[Trial]) -> list[Trial]:
    """Short ones first, file by file: what serves a file is computed twice at most."""
    files = list(dict.fromkeys(trial.file for trial in trials))
    return sorted(trials, key=lambda trial: (trial.seconds > _SHORT_S, files.index(trial.file)))


def _derivatives(name: str, tree: ast.Module) -> set[str]:
    """A name of a module, and others of it that are computed from it."""
    names, grown = {name}, True
    while grown:
        before = len(names)
        for stmt in tree.body:
            if isinstance(stmt, ast.Assign | ast.AnnAssign) and {_name(part) for part in ast.walk(stmt)} & names:
                targets = stmt.targets if isinstance(stmt, ast.Assign) else [stmt.target]
                names |= {part.id for target in targets for part in ast.walk(target) if isinstance(part, ast.Name)}
        grown = len(names) > before
    return names


def _name(node: ast.AST) -> str | None:
    return getattr(node, "id", None) or getattr(node, "attr", None)
