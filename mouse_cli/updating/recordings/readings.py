"""Recordings read otherwise than a deck says, and what the model as it is leaves of them in closed form."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import Channel, Recording
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.records import in_order, records, reduced
from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.study import Study

_EQUAL = 1.5  # times what the best reading leaves, up to which another one fits as well
_FAR = 5.0  # prior standard deviations that nuisances may move in the right reading


@dataclass(frozen=True)
class Reading:
    """What is taken to be so, what to do, and the record in that reading."""

    said: str
    remedy: str
    of: Callable[[Recording], Recording]


def record_of(own: Study, look: Series) -> tuple[Recording, np.ndarray]:
    """The recording that a series is of, its channels in the order of the first, and its outputs (t, s) as they were read."""
    title, first = look.title.removesuffix(", its end"), own.problem.recordings[0]
    record = in_order(next(one for one in own.problem.recordings if one.title == title), first)
    return record, record.samples[:, columns_of(own.problem, own.records.outputs)]


def columns_of(problem: Problem, channels: tuple[Channel, ...]) -> list[int]:
    """Of channels of the first recording: files of other runs may call theirs otherwise."""
    return [problem.recordings[0].channels.index(one) for one in channels]


def looked(own: Study, look: Series) -> Regression:
    return Regression(Spectrum(look, own.model.linear), own.base.placed(own.places[0]))


def reread(own: Study, record: Recording, seen: Series) -> Regression | None:
    """What the model makes of a record in that reading; None where it cannot judge."""
    try:
        (series,) = records(replace(own.problem, recordings=(record,), held_records=None)).fitted
    except DeckError:
        return None
    look = reduced(series, own.model).part(0, len(seen))
    return looked(own, replace(look, slow=seen.slow, disturbance=seen.disturbance))


def share_left(own: Study, record: Recording, outputs: list[int], seen: Series) -> float:
    """Share of a record that is left; infinite where it cannot judge in that reading, or moves nuisances out of their prior."""
    at = reread(own, record, seen)
    return np.inf if at is None or strained(at) else shares_left(at, record.samples[:, outputs])[0]


def strained(at: Regression) -> bool:
    """Whether nuisances of the model leave their prior."""
    z = at.begin(np.zeros_like(at.y), np.zeros(0))[0][: at.base.linear.k]
    return bool(np.abs(z).max(initial=0.0) > _FAR)


def shares_left(at: Regression, samples: np.ndarray) -> tuple[float, np.ndarray]:
    """Share of outputs as they were read, samples (t, s), that the linear model leaves, and that of each (s,).

    Of motions relative to the ground a share would be small where outputs are read as nothing.
    """
    spectrum, own = at.spectrum, samples[: len(at.spectrum.series)]
    size = (spectrum.whitened((own - own.mean(axis=0)) * spectrum.window[:, None])[at.kept] ** 2).sum(axis=0)
    if not size.all():  # no line is left of the band, such as beside the mains at another sample rate
        return np.inf, np.full(len(size), np.inf)
    return at.nothing / float(size.sum()), (at.left[at.kept] ** 2).sum(axis=0) / size


def diagnostic(problem: Problem, record: Recording, before: float, found: list[tuple[float, Reading]]) -> Diagnostic:
    """The first of the readings that fit alike, and the others beside it."""
    least = min(left for left, _ in found)
    alike = {each.said: each.remedy for left, each in found if left < _EQUAL * least}
    (said, remedy), *rest = alike.items()
    name = f"recording '{record.title}'"
    message = (
        f"the model leaves {100 * min(before, 1.0):.3g} % of {name}{f' ({record.path})' if record.path else ''} unexplained; "
        f"{said}, it would leave {100 * least:.2g} %"
    )
    note = "; ".join(f"{other}: {mend}" for other, mend in rest[:3])
    return Diagnostic("MD457", ERROR, message, problem.place(name), f"as well fits: {note}" if note else "", remedy)


def named(record: Recording, columns: Sequence[int]) -> str:
    return f"channel{'s' * (len(columns) > 1)} {', '.join(record.channels[j].name for j in columns)}"


def changed(columns: Sequence[int], factor: float, **stated) -> Callable[[Recording], Recording]:
    """Channels times a factor, and whatever else is stated of them."""

    def of(one: Recording) -> Recording:
        size = np.ones(len(one.channels))
        size[list(columns)] = factor
        channels = tuple(replace(c, **stated) if j in columns else c for j, c in enumerate(one.channels))
        return replace(one, channels=channels, samples=one.samples * size)

    return of
