"""Which combinations of features are asked for."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np

from tests.pairs.features import FEATURES, Feature
from tests.pairs.machines import BASES
from tests.pairs.scroll_features import PIN_FEATURES, SCROLL_FEATURES

Combination = tuple[str, tuple[str, ...]]

#: a request for the loads of pins, which has no machine
PINS = "pins"
_OWN: Mapping[str, Mapping[str, Feature]] = {"scroll": {**FEATURES, **SCROLL_FEATURES}, PINS: PIN_FEATURES}

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
    ("scroll", ("plates, segments", "fitted")),
    (PINS, ("torque of both signs", "comparison with a heavy ring")),
)


def features_of(base: str) -> Mapping[str, Feature]:
    """What can be put on a machine, or on a request for the loads of pins."""
    return _OWN.get(base, FEATURES)


def all_pairs() -> Iterator[Combination]:
    """Every pair of features on every machine."""
    for base in BASES:
        for pair in combinations(features_of(base), 2):
            yield base, pair


def pairs_of_pins() -> Iterator[Combination]:
    """Every pair of features of a request for the loads of pins."""
    yield from ((PINS, pair) for pair in combinations(PIN_FEATURES, 2))


def pairs_of_scrolls() -> Iterator[Combination]:
    """Every pair on a scroll of which a feature is one of scrolls alone."""
    yield from ((base, pair) for base, pair in all_pairs() if base == "scroll" and not set(pair) <= set(FEATURES))


def some_pairs() -> list[Combination]:
    """Every so many of all pairs, and what once was wrong."""
    pairs = [*all_pairs(), *pairs_of_pins()]
    return [*ONCE_WRONG, *(pair for n, pair in enumerate(pairs) if n % _STRIDE == 0)]


def pairs_with_shafts() -> Iterator[Combination]:
    """Every feature beside every kind of balance shaft, on the machines that have a place for these."""
    shafts = [name for name in FEATURES if name.startswith("balance shaft")]
    for base in BASES:
        for shaft in shafts if "throws" in BASES[base]["machine"] else ():
            yield from ((base, (shaft, name)) for name in FEATURES if name not in shafts)


def random_triples(count: int, seed: int = _SEED) -> Iterator[Combination]:
    """Features in any order, most of them on the machines that have a place for all."""
    chance, bases = np.random.default_rng(seed), [*BASES, PINS]
    for _ in range(count):
        base = bases[int(chance.choice(len(bases), p=[0.4, 0.35, 0.2, 0.05]))]
        names = list(features_of(base))
        yield base, tuple(names[int(n)] for n in chance.choice(len(names), 3, replace=False))
