"""Which combinations of features are asked for."""

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from tests.pairs.features import FEATURES
from tests.pairs.machines import BASES

Combination = tuple[str, tuple[str, ...]]

#: between pairs of the short list, prime to the number of all, so that every feature comes along
_STRIDE = 89
_SEED = 20261123

#: what once raised or was wrong, by its kind
ONCE_WRONG: Sequence[Combination] = (
    ("twin", ("force_ceiling_N slack", "bearing_ceiling_N slack")),
    ("twin", ("moment_ceiling_x_Nm near", "bending_ceiling_Nm slack")),
    ("vee", ("force_ceiling_y_N slack", "specific_load_ceiling_Pa near")),
    ("vee", ("webs at an end bearing", "bending alone", "steps")),
    ("vee", ("webs in the reference plane", "moment alone", "masses of a catalogue")),
    ("vee", ("webs in the reference plane", "moment alone", "part numbers")),
    ("vee", ("three bearings", "bending weight", "no webs")),
    ("vee", ("three bearings", "bending alone", "no webs")),
    ("vee", ("three bearings", "bending_ceiling_Nm near", "no webs")),
    ("vee", ("three bearings", "priorities", "no webs")),
    ("vee", ("three bearings", "bending alone", "webs at an end bearing")),
    ("twin", ("few counterweights", "all fixed")),
    ("twin", ("masses of a catalogue", "fixed")),
    ("vee", ("least fitted", "least mass false", "bending weight")),
    ("twin", ("external, then mass", "balance shaft backwards")),
    ("twin", ("cheaper choices", "no largest mass")),
    ("twin", ("no counterweights", "no webs", "balance shaft backwards")),
)


def all_pairs() -> Iterator[Combination]:
    """Every pair of features on every machine."""
    for base in BASES:
        for pair in combinations(FEATURES, 2):
            yield base, pair


def some_pairs() -> list[Combination]:
    """Every so many of all pairs, and what once was wrong."""
    return [*ONCE_WRONG, *(pair for n, pair in enumerate(all_pairs()) if n % _STRIDE == 0)]


def pairs_with_shafts() -> Iterator[Combination]:
    """Every feature beside every kind of balance shaft, on the machines that have a place for these."""
    shafts = [name for name in FEATURES if name.startswith("balance shaft")]
    for base in BASES:
        for shaft in shafts if "throws" in BASES[base]["machine"] else ():
            yield from ((base, (shaft, name)) for name in FEATURES if name not in shafts)


def random_triples(count: int, seed: int = _SEED) -> Iterator[Combination]:
    """Features in any order, most of them on the machines that have a place for all."""
    chance, names, bases = np.random.default_rng(seed), list(FEATURES), list(BASES)
    for _ in range(count):
        base = bases[int(chance.choice(len(bases), p=[0.45, 0.4, 0.15]))]
        yield base, tuple(names[int(n)] for n in chance.choice(len(names), 3, replace=False))
