"""Programs in units of their own, compiled: what both methods begin with, and the form that the one for discs takes."""

from optimizer.program.kernel.compiling import in_place

#: multiple of the natural reach beyond which limits are ignored
_REACH = 10.0
#: of the largest influence, by which those of a vector may miss a multiple of force or moment: their rounding
_SAME = 1e-14


@in_place
def scales(  # type: ignore[no-untyped-def]
    rest,
    influence,
    changes,
    single,
    radius,
    most,
    budget,
    at_least,
    share,
    sharpness,
    finest,
    coarsest,
    reach,
    unit,
    targets,
):
    """Reach of the webs, unit of the objective, and share and gap in that unit, of N programs.

    Parameters
    ----------
    rest : (N,) sum of the sizes of the J terms without counterweights.
    influence : (N, J, K) of the terms, real.
    changes, single : (N, K) kg m, sizes of what cancels everything, and (N,) the largest that one vector calls for.
    radius, most, budget : (N, K) radius and (N, K) largest mass of the webs, and (N,) budget.
    at_least : (N,) what the objective comes to under the ceilings, or less.
    share : (N,) what optima may differ by.
    sharpness, finest, coarsest : gap of the first stage: as a share of that, and between which ends.
    reach, unit, targets : (N, K), (N,) and (2, N), results: the last are the share and the gap.
    """
    number, terms, webs = influence.shape
    for n in range(number):
        reachable, natural = 0.0, single[n]
        for k in range(webs):
            natural = max(natural, changes[n, k])
        for k in range(webs):
            reach[n, k] = min(radius[n, k] * min(most[n, k], budget[n]), _REACH * natural)
        for j in range(terms):
            for k in range(webs):
                reachable += abs(influence[n, j, k]) * reach[n, k]
        own = rest[n] if rest[n] > 0.0 else reachable if reachable > 0.0 else 1.0
        # from far below its level the search hardly arrives
        unit[n] = max(own, at_least[n])
        targets[0, n] = share[n] / unit[n]
        targets[1, n] = min(max(sharpness * share[n] / unit[n], finest), coarsest)


@in_place
def forms(  # type: ignore[no-untyped-def]
    constant,
    influence,
    multiple,
    terms,
    radius,
    budget,
    free,
    centre,
    cosine,
    sine,
    cap,
    size,
    margin,
    reach,
    unit,
    budgeted,
    of_multiple,
    of_constant,
    of_influence,
    mass,
    of_budget,
    of_cap,
    normals,
):
    """N programs as :class:`optimizer.program.kernel.disc_starts.Discs` has them.

    Parameters
    ----------
    constant, multiple : (N, Q), of the terms and of what is under ceilings.
    influence : (N, B, K) on one or both of two responses.
    radius, budget : (N, K) radius of the webs, and (N,) budget.
    free, centre, cosine, sine : (N, K) whether there is no sector, centre, cosine and sine of the half-angle.
    cap, size : (N, I) of the ceilings.
    margin : share of its size by which a ceiling is lowered.
    reach, unit : of :func:`scales`.
    budgeted : (N,) bool, whether the budget can bind, to be written to.
    of_multiple, of_constant, of_influence, mass, of_budget, of_cap, normals : the seven arrays that follow the basis,
        likewise.
    """
    (number, webs), vectors = mass.shape, multiple.shape[1]
    for n in range(number):
        for q in range(vectors):
            scale = unit[n] if q < terms else size[n, q - terms]
            of_multiple[n, q] = multiple[n, q] / scale
            # as numpy divides what is complex
            inverse = 1.0 / scale
            of_constant[n, q, 0], of_constant[n, q, 1] = constant[n, q].real * inverse, constant[n, q].imag * inverse
        total = 0.0
        for k in range(webs):
            mass[n, k] = reach[n, k] / radius[n, k]
            total += mass[n, k]
            for b in range(2):
                of_influence[n, b, k] = influence[n, b, k] * reach[n, k] if b < influence.shape[1] else 0.0
        for k in range(normals.shape[2]):
            # the centre turned by the rest to a right angle
            present = 0.0 if free[n, k] else 1.0
            c, s, x, y = present * cosine[n, k], present * sine[n, k], centre[n, k].real, centre[n, k].imag
            normals[n, 0, k], normals[n, 1, k] = s * x - c * y, s * y + c * x
            normals[n, 2, k], normals[n, 3, k], normals[n, 4, k] = s * x + c * y, s * y - c * x, present
        budgeted[n] = total > budget[n]
        for k in range(webs):
            of_budget[n, k] = mass[n, k] / budget[n] if budgeted[n] else 0.0
        for i in range(cap.shape[1]):
            own = cap[n, i] / size[n, i]
            of_cap[n, i] = own - min(max(own, 0.0), margin)


@in_place
def pairs(influence, basis, multiple, two, holds):  # type: ignore[no-untyped-def]
    """Vectors of N programs as multiples of two, the largest of either response: of equal ones the first.

    Parameters
    ----------
    influence : (N, Q, K) of all vectors.
    basis : (Q,) of which response, 0 or 1.
    multiple, two, holds : (N, Q), (N, 2, K) and (N,) bool, results: whether the vectors are such multiples.
    """
    number, vectors, webs = influence.shape
    second_count = 0
    for q in range(vectors):
        second_count += basis[q]
    for n in range(number):
        same = True
        for b in range(2):
            largest, most, square = -1, -1.0, 0.0
            for q in range(vectors):
                if basis[q] == b:
                    size = 0.0
                    for k in range(webs):
                        size = max(size, abs(influence[n, q, k]))
                    # until it is a multiple
                    multiple[n, q] = size
                    largest, most = (q, size) if size > most else (largest, most)
            for k in range(webs):
                two[n, b, k] = influence[n, largest, k] if largest >= 0 else 0.0
                square += two[n, b, k] * two[n, b, k]
            alone = (second_count if b > 0 else vectors - second_count) < 2
            for q in range(vectors):
                if basis[q] == b:
                    along, off, allowed = 0.0, 0, _SAME * multiple[n, q]
                    for k in range(webs):
                        along += influence[n, q, k] * two[n, b, k]
                    along = along / square if square > 0.0 else along
                    for k in range(webs):
                        off += 0 if abs(influence[n, q, k] - along * two[n, b, k]) <= allowed else 1
                    multiple[n, q] = 1.0 if alone else along
                    same = same and (alone or off == 0)
        holds[n] = same
