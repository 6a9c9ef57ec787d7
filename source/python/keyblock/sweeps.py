# SPDX-License-Identifier: LGPL-2.1-or-later
"""Limit equilibrium over values of entries."""
import dataclasses
import itertools
import math

import numpy

from . import _core


@dataclasses.dataclass(frozen=True)
class Sample:
    """One combination of values.

    index: its place in the arrays of the Sweep.
    values: of the entries, by "Section/Entry".
    results: list of LimitEquilibrium, all blocks with a free face by stage.
    """
    index: tuple
    values: dict
    results: list

    @property
    def least(self):
        """The LimitEquilibrium with the least factor; None: nothing is free."""
        return min(self.results, key=lambda one: one.factor, default=None)


@dataclasses.dataclass(frozen=True)
class Sweep:
    """What sweep() found.

    entries: tuple of the entries that vary, one for each axis of the arrays.
    values: their values, a tuple for each axis.
    factor: least factor of all blocks and stages, one number for each
        combination; inf: nothing can move.
    samples: list of Sample; under mpirun those of this rank. Looping over the
        Sweep gives them, too.
    """
    entries: tuple
    values: tuple
    factor: numpy.ndarray
    samples: list

    def __iter__(self):
        return iter(self.samples)


# the kinds of errors that one rank tells the others of; of others there is the text
_KINDS = (_core.Error, _core.ComputationError, RuntimeError)


def _names(key):
    return (key,) if isinstance(key, str) else tuple(key)


def _values_of(entries):
    """The values of each entry; raises Error unless these are sequences."""
    for key, list_ in entries.items():
        if isinstance(list_, (str, bytes)) or not hasattr(list_, "__iter__"):
            raise _core.Error(f"The sweep is to vary {' and '.join(_names(key))} over "
                              f"{list_!r}, which is one value; put it into a list.")
    return tuple(tuple(list_) for list_ in entries.values())


def _raise_on_all(number, error):
    """Raise on all ranks what the first combination raised that a rank failed at.

    number: this rank's, if it has an error."""
    rank, size = _core.rank(), _core.size()
    if size == 1:
        if error:
            raise error
        return
    text = str(error).encode()
    failed = numpy.zeros((size, 3))
    if error:
        kind = [isinstance(error, one) for one in (*_KINDS[:-1], Exception)].index(True)
        failed[rank] = number + 1, kind, len(text)
    failed = _core.sum_over_ranks(failed)
    ranks = numpy.flatnonzero(failed[:, 0])
    if not len(ranks):
        return
    first = ranks[failed[ranks, 0].argmin()]
    kind, length = map(int, failed[first, 1:])
    shared = numpy.zeros(length + 1)  # not empty, whatever the text
    if rank == first:
        shared[:length] = list(text)
    shared = _core.sum_over_ranks(shared)
    raise _KINDS[kind](bytes(shared[:length].astype(numpy.uint8)).decode()) from error


def sweep(scene, entries, *, stage=None, wanted=0.):
    """Limit equilibrium for all combinations of values of some entries.

    scene: a Scene, or the name of a file.
    entries: sequences of values by "Section/Entry", as {"Joints/*/Friction
        angle": [25, 30, 35], "Water/Level": [0, 5]}; several entries that have
        the same value: a tuple of them.
    stage: only results after this stage; None: after all.
    wanted: factor to tell the support for.

    Returns a Sweep. The scene is meshed once where all entries are strengths,
    loads or water (leaves_geometry()), else for each combination. Under mpirun
    the ranks share the combinations, each with scenes of its own.
    Raises Error, also for a combination that cannot be used; under mpirun on all
    ranks, that of the first such combination.
    """
    keys, values = list(entries), _values_of(entries)
    if not (wanted >= 0. and math.isfinite(wanted)):
        raise _core.Error(f"The sweep is to tell the support for a factor of {wanted}; give "
                          "a number above 0, or 0 for none.")
    if not isinstance(scene, _core.Scene):
        scene = _core.Scene(scene, alone=True)
    if not scene.alone:
        scene = scene.alone_again()
    if stage is not None and stage not in (*scene.stages, "start"):
        raise _core.Error(f"The sweep is to look at a stage '{stage}', which the scene "
                          f"does not have; it has start, {', '.join(scene.stages)}.")
    factor = numpy.zeros([len(list_) for list_ in values])
    stays = all(_core.leaves_geometry(name) for key in keys for name in _names(key))
    blocks = _core.find_blocks(scene) if stays else None
    rank, size, samples = _core.rank(), _core.size(), []
    number, error = 0, None
    try:
        for number, index in enumerate(itertools.product(*map(range, factor.shape))):
            if number % size != rank:
                continue
            chosen = {name: values[axis][i] for axis, i in enumerate(index)
                      for name in _names(keys[axis])}
            changed = scene.with_overrides(chosen)
            found = blocks if stays else _core.find_blocks(changed)
            results = [one for one in found.limit_equilibrium(changed, wanted=wanted)
                       if stage in (None, one.stage)]
            samples.append(Sample(index, chosen, results))
            factor[index] = min((one.factor for one in results), default=numpy.inf)
    except Exception as fault:  # the other ranks would wait for this one for ever
        error = fault
    _raise_on_all(number, error)
    if size > 1:
        factor = _core.sum_over_ranks(factor)
    return Sweep(tuple(keys), values, factor, samples)
