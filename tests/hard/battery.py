"""Runs the hard cases through the service's own computation and sums up what became of them."""

import json
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from tests.hard.cases.case import Case
from tests.hard.judge import Verdict, judge
from tests.hard.reference import Reference
from tests.verification.checking import broken, is_checked

_WORST = (
    ("certified relative gap", lambda verdict: verdict.relative_gap),
    ("certified gap of the least mass", lambda verdict: verdict.mass_gap),
    ("objective against the reference", lambda verdict: abs(verdict.objective_error)),
    ("peaks against the reference", lambda verdict: verdict.peak_error),
    ("least mass against the reference", lambda verdict: abs(verdict.mass_error)),
)


def run(case: Case, expected: Reference | None) -> Verdict:
    """One case; an exception or a warning is a fault like any other."""
    start = time.perf_counter()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            answer = optimize(OptimizeRequest.model_validate(case.body))
    except Exception as error:  # whatever it is, it is what the battery looks for
        return Verdict(case, seconds=time.perf_counter() - start, faults=[f"{type(error).__name__}: {error}"])
    seconds = time.perf_counter() - start
    verdict = judge(case, answer, expected)
    verdict.seconds = seconds
    if is_checked():
        verdict.faults += broken(case.body, json.loads(answer.model_dump_json()))
    return verdict


def warm_up(cases: Iterable[Case]) -> None:
    """Import the solver before anything is timed."""
    for case in list(cases)[:1]:
        run(case, None)


def summary(verdicts: list[Verdict], console: Console) -> None:
    """Print what became of the cases: a table by theme, the worst, and every fault."""
    console.print(_themes(verdicts))
    console.print(_worst(verdicts))
    methods = Counter(verdict.method or verdict.status for verdict in verdicts)
    console.print("answered by: " + ", ".join(f"{escape(name)} {count}" for name, count in methods.most_common()))
    failed = [verdict for verdict in verdicts if verdict.faults]
    for verdict in failed:
        console.print(f"[red]{escape(verdict.case.name)}[/red] ({escape(verdict.case.why)})")
        for fault in verdict.faults:
            console.print(f"    {escape(fault)}")
    console.print(f"{len(verdicts)} cases, {len(failed)} failed")


def _themes(verdicts: list[Verdict]) -> Table:
    table = Table("theme", "cases", "optimal", "infeasible", "inaccurate", "exception", "failed", "worst gap")
    themes = dict.fromkeys(verdict.case.theme for verdict in verdicts)
    for theme in (*themes, "all"):
        chosen = [verdict for verdict in verdicts if theme in (verdict.case.theme, "all")]
        statuses = Counter(verdict.status for verdict in chosen)
        counts = [statuses[name] for name in ("optimal", "infeasible", "inaccurate", "exception")]
        failed = sum(bool(verdict.faults) for verdict in chosen)
        gap = max(verdict.relative_gap for verdict in chosen)
        table.add_row(theme, str(len(chosen)), *map(str, counts), str(failed), f"{gap:.1e}")
    return table


def _worst(verdicts: list[Verdict]) -> Table:
    table = Table("", "ordinary", "in case", "all", "in case")

    def worst(chosen: list[Verdict], measure: Callable[[Verdict], float]) -> tuple[str, str]:
        if not chosen:
            return "", ""
        verdict = max(chosen, key=measure)
        return f"{measure(verdict):.1e}", escape(verdict.case.name)

    ordinary = [verdict for verdict in verdicts if verdict.case.ordinary]
    for name, value in _WORST:
        table.add_row(name, *worst(ordinary, value), *worst(verdicts, value))
    table.add_row("slowest, s", *worst(ordinary, _seconds), *worst(verdicts, _seconds))
    return table


def _seconds(verdict: Verdict) -> float:
    return verdict.seconds
