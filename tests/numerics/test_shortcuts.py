"""What the compiler works out once is what it works out again and again."""

import hashlib
import os
import subprocess
import sys

from tests.night import at_night

#: an operator for the same types with other options, an array that is made, a vector loop, a module's constant
_CODE = """
import sys
import numpy as np
from numba import njit
from optimizer.numerics.compiling import fused, inner_with_arrays
from optimizer.numerics.shortcuts import take_shortcuts
if sys.argv[1] == "short":
    take_shortcuts()

@fused
def moved(values, step):
    for i in range(values.size):
        values[i] = max(values[i], 0.5) + step * values[i] ** 3 - np.pi

@inner_with_arrays
def largest(values):
    result = np.zeros(2)
    for i in range(values.size):
        result[i % 2] = max(result[i % 2], np.sqrt(abs(values[i]))) ** 3
    return result

@njit(error_model="numpy")
def entry(values, step):
    first = largest(values)
    moved(values, step)
    return first[0] + 2.0 * largest(values[::2])[1]

print(entry(np.linspace(-1.0, 2.0, 9), 0.25))
print(next(iter(entry.inspect_asm().values())))
"""


# two compilers; only another release of numba changes it
@at_night
def test_machine_code_is_the_same() -> None:
    # variables are kept in sets, the order of which is that of places on the stack
    fixed = {**os.environ, "PYTHONHASHSEED": "0"}
    first, second = (
        subprocess.run(
            [sys.executable, "-c", _CODE, way], capture_output=True, text=True, timeout=300, check=True, env=fixed
        ).stdout
        for way in ("whole", "short")
    )
    assert first.count("\n") > 100
    assert hashlib.sha256(first.encode()).hexdigest() == hashlib.sha256(second.encode()).hexdigest()
