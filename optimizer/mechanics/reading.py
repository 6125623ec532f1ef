"""Forces in the mechanism of a row that curves over the turn are made of, by their names."""

from typing import Literal, get_args

Reading = Literal[
    "piston",
    "rod",
    "rod_without_gas",
    "rod_at_rest",
    "side",
    "tangential",
    "radial",
    "on_shaft",
    "on_frame",
    "gas",
    "inertia",
]
#: all of them; what is compiled knows them by their places
READINGS: tuple[Reading, ...] = get_args(Reading)
#: of these the gas is no part
WITHOUT_GAS: tuple[Reading, ...] = ("rod_without_gas", "on_frame", "inertia")
