"""Whether what is fitted can be made: no dust beside other counterweights, no plates that all but differ."""

import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tests.dust.modes import MODES, Fitted
from tests.hard.cases.case import Body

#: what is lighter than this share of the heaviest is dust
DUST = 1e-4
#: half-angles of plates of one kind that differ by less are one, degrees
ALIKE_DEG = 1e-3


@dataclass(frozen=True)
class Judgement:
    """What came of one machine."""

    mode: str
    seed: int
    answers: int
    open: int  # answers that are neither optimal nor infeasible
    dust: tuple[str, ...]  # what is wrong with each answer that is at fault
    needed: int  # webs that carry next to nothing and of which it is proven that no such answer lacks them
    unlike: tuple[str, ...]
    cpu_s: float


def body_of(mode: str, seed: int) -> Body:
    return MODES[mode].draw(np.random.default_rng([seed, *mode.encode()]))


def judgement(mode: str, seed: int) -> Judgement:
    """The machine of a seed, asked for in a mode."""
    body = body_of(mode, seed)
    began = time.process_time()
    answers = list(MODES[mode].answers(body))
    spent = time.process_time() - began
    small = [(answer, web) for answer in answers for web in _dust(answer)]
    dust = [_mass_text(answer, web) for answer, web in small if not answer.needs(web)]
    unlike = [difference for answer in answers for difference in _unlike(body, answer)]
    left = sum(answer.status not in ("optimal", "infeasible") for answer in answers)
    return Judgement(mode, seed, len(answers), left, tuple(dust), len(small) - len(dust), tuple(unlike), spent)


def seeds(count: int, only: str | None = None) -> Iterator[tuple[str, int]]:
    """Modes and seeds of so many machines, modes by their weights."""
    weights = {name: mode.weight for name, mode in MODES.items() if only in (None, name)}
    together, sum_so_far = sum(weights.values()), 0
    for name, weight in weights.items():
        first = count * sum_so_far // together
        sum_so_far += weight
        for seed in range(count * sum_so_far // together - first):
            yield name, seed


def _dust(answer: Fitted) -> list[str]:
    """Webs that carry next to nothing."""
    most = max(answer.mass_kg.values(), default=0.0)
    return [web for web, mass in answer.mass_kg.items() if 0 < mass <= DUST * most]


def _mass_text(answer: Fitted, web: str) -> str:
    return f"{web}: {answer.mass_kg[web]:.2e} kg beside {max(answer.mass_kg.values()):.3g} kg"


def _unlike(body: Body, answer: Fitted) -> Iterator[str]:
    kinds = {web["name"]: web.get("envelope") for web in body.get("machine", {}).get("webs", ())}
    plates = sorted(answer.opened_deg.items(), key=lambda opened_deg: opened_deg[1])
    for number, (web, opened) in enumerate(plates):
        for text, larger in plates[number + 1 :]:
            if kinds[web] == kinds[text] and 0 < larger - opened < ALIKE_DEG:
                yield f"{web} and {text}: {opened:.6f} and {larger:.6f} degrees"
