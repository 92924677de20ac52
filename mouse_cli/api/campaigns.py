"""Campaigns on one deck: many runs of it by processes."""

import os
from collections.abc import Mapping, Sequence
from math import prod

from mouse_cli.model.campaign import Sweep


def sweep(
    deck: str | os.PathLike[str],
    vary: Mapping[str, Sequence[float | int | str | bool]],
    folder: str | os.PathLike[str],
    *,
    jobs: int | None = None,
    outside: bool = False,
) -> Sweep:
    """How the answer to a deck depends on uncertain assumptions: run at every combination of values, as `mouse sweep` does.

    vary: values of a property, PROPERTY.sd, frequency_sd*, shape_sd* (factors) or the path of a value in the deck. folder: where
    the answers are kept, and not sought again. jobs: processes (None: one for each core). outside: the deck may name files outside
    of its own folder. Raises DeckError, ValueError without values, WrittenError.

    >>> import tempfile
    >>> import mouse_cli
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = mouse_cli.sweep("decks/table_5_2.yaml", {"k1.sd": [15e3, 25e3]}, folder, jobs=1)
    >>> [each.name for each in found.parameters], len(found.answers), found.exit_code
    (['k1', 'k2'], 2, 0)
    """
    from mouse_cli.batch.changes import kind
    from mouse_cli.batch.folder import held
    from mouse_cli.batch.job import Job
    from mouse_cli.batch.processes import cores, outcomes
    from mouse_cli.campaigns import sweep as campaign
    from mouse_cli.campaigns.design import Varied, grid
    from mouse_cli.formats import read_deck

    path = os.fspath(deck)
    problem = read_deck(path, outside=outside)
    varied = tuple(Varied(name, kind(name, problem), tuple(values)) for name, values in vary.items())
    if not prod(len(each.values) for each in varied):
        raise ValueError("a quantity has no values")
    campaign.checked(path, problem, varied)
    points = grid(varied)
    every = [Job(path, outside=outside), *campaign.jobs(path, varied, points, {}, outside)]
    with held(os.fspath(folder)):
        found = dict(outcomes(every, os.fspath(folder), jobs or cores()))
    return campaign.summed(problem, varied, points, [found[i + 1] for i in range(len(points))], found[0])
