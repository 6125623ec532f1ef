"""Arrays and their exact sums. Leading axes are programs or machines; vectors across the shaft are complex, x + jy."""

import math
from collections.abc import Callable
from functools import partial
from math import hypot
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
#: one number, or one for each of many programs
Reals = Real | float

Part = TypeVar("Part")

#: a sum smaller than this share of the sum of the magnitudes of its terms is rounding error
ROUNDING = 16 * float(np.finfo(float).eps)
#: so few sums are compared sooner in plain numbers than by arrays
_FEW = 16
#: so few numbers are copied sooner than shared
_SMALL = 256
_ARRAYS = (np.ndarray, np.generic)
#: what dataclasses hold most that is no array and no dataclass
_PLAIN = frozenset({type(None), tuple, float})
#: nothing real is this small; below it quotients lose their digits and then overflow
SMALLEST = 1e-250


def variant(part: Part, **fields: Any) -> Part:
    """The same dataclass with other contents of some fields, in a quarter of the time of ``dataclasses.replace``."""
    own = vars(part)
    # without what is cached there: it may be another one
    return type(part)(**{name: own[name] for name in type(part).__dataclass_fields__} | fields)  # type: ignore[attr-defined]


def mapped(part: Part, function: Callable[[Any], Any]) -> Part:
    """The same dataclass with a function of every array in it, parts within parts too; what is no array stays."""
    own = vars(part)
    # without what is cached there: it is of other arrays
    fields = {name: own[name] for name in type(part).__dataclass_fields__}  # type: ignore[attr-defined]
    for name, value in fields.items():
        kind = type(value)
        if kind in _PLAIN:
            continue
        if kind is np.ndarray or isinstance(value, _ARRAYS):
            fields[name] = function(value)
        elif hasattr(kind, "__dataclass_fields__"):
            fields[name] = mapped(value, function)
    return type(part)(**fields)


def spread(array: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    """The same numbers along leading axes, of a shape that ends with their own; of many what is common to all is not
    copied. None may be written to."""
    if array.shape == shape:
        return array
    size = math.prod(shape)
    if array.size == size:
        # a view as well, in a tenth of the time
        return array.reshape(shape)
    if size > _SMALL:
        return np.broadcast_to(array, shape)
    # a copy in a fifth of the time
    copies = np.empty(shape, array.dtype)
    copies[...] = array
    return copies


def side_by_side(*arrays: NDArray[Any]) -> NDArray[Any]:
    """All (..., n) on one last axis, leading axes broadcast."""
    if len({array.shape[:-1] for array in arrays}) == 1:
        return np.concatenate(arrays, axis=-1)
    leading = np.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    return np.concatenate([spread(array, (*leading, array.shape[-1])) for array in arrays], axis=-1)


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """The same numbers, which cannot be written there: an answer keeps them without a copy."""
    view = array.view()
    view.flags.writeable = False
    return view


def single_axis(leading: tuple[int, ...], array: NDArray[Any], own: int) -> NDArray[Any]:
    """An array with one axis in place of leading axes, which it has or is spread along, and its last ``own`` axes."""
    if not leading and array.ndim == own:
        return in_order(array)[None]
    last = array.shape[array.ndim - own :]
    if array.shape != (*leading, *last):
        array = spread(array, (*leading, *last))
    return in_order(array).reshape(math.prod(leading), *last)


def of_programs_of(leading: tuple[int, ...]) -> Callable[[NDArray[Any], int], NDArray[Any]]:
    """:func:`single_axis` of these leading axes; of one program alone, which has dozens of arrays, in half the time."""
    return partial(single_axis, leading) if leading else _alone


def _alone(array: NDArray[Any], own: int) -> NDArray[Any]:
    return array[None] if array.ndim == own and array.flags.carray else single_axis((), array, own)


def plain(array: NDArray[Any]) -> NDArray[Any]:
    """The same numbers in the usual order in memory, free to be written to.

    For any other order, and for what is read-only, a kernel would be compiled once more.
    """
    return np.array(array, order="C")


def parts(vectors: Complex) -> Real:
    """Real and imaginary parts side by side (..., 2), free to be written to."""
    return plain(vectors).view(float).reshape(*vectors.shape, 2)


def in_order(array: NDArray[Any]) -> NDArray[Any]:
    """The same numbers in the usual order in memory; not copied where they are in it, so that none may be written to.

    As of :func:`plain`, kernels are compiled once for them.
    """
    return array if array.flags.carray else np.array(array, order="C")


def columns(array: NDArray[Any], selection: NDArray[np.bool_]) -> NDArray[Any]:
    """Some of the numbers (..., K) along the last axis, in the usual order in memory.

    Parameters
    ----------
    selection : (K,); or (N, K), as many of each row, of an array (N, ..., K).
    """
    if selection.ndim == 1:
        return array[..., selection].copy()
    mask = np.broadcast_to(np.expand_dims(selection, tuple(range(1, array.ndim - 1))), array.shape)
    return array[mask].reshape(*array.shape[:-1], np.count_nonzero(selection[:1]))


def any_true(mask: NDArray[np.bool_]) -> bool:
    """Whether any of a mask (...) is true: by its bytes, in an eighth of the time of a reduction."""
    return 1 in mask.tobytes()


def all_true(mask: NDArray[np.bool_]) -> bool:
    """Whether all of a mask (...) are true, as :func:`any_true`."""
    return 0 not in mask.tobytes()


def total(terms: Complex) -> Complex:
    """Sum over the last axis; exactly zero where the terms cancel up to rounding.

    A machine that balances itself then has a baseline of zero, not of 1e-13 N, and is the
    ordinary case that it should be.

    Parameters
    ----------
    terms : (..., n) complex.

    Returns
    -------
    (...) complex.
    """
    value, size = np.add.reduce(terms, axis=-1), np.add.reduce(np.abs(terms), axis=-1)
    if value.size <= _FEW:
        return _few_without_noise(value, size)
    cancelled = np.abs(value) <= np.maximum(ROUNDING * size, SMALLEST)
    return np.where(cancelled, 0.0, value) if any_true(cancelled) else value


def _few_without_noise(value: Complex, size: Real) -> Complex:
    """Sums of one machine (...), 0 where they are rounding error of terms of these magnitudes (...)."""
    sums = value.ravel().tolist()
    cancelled = [
        hypot(entry.real, entry.imag) <= max(ROUNDING * most, SMALLEST)
        for entry, most in zip(sums, size.ravel().tolist(), strict=True)
    ]
    if True not in cancelled:
        return np.asarray(value)
    left = [0j if nothing else entry for entry, nothing in zip(sums, cancelled, strict=True)]
    return np.array(left).reshape(value.shape)
