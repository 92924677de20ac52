"""Portions of jobs: what is handed to a process at once, since handing over costs about a millisecond."""

import os
from collections.abc import Callable
from dataclasses import dataclass

from mouse_cli.batch.job import Job
from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.work import perform

_PORTION_S = 0.1  # seconds of work in one portion
_MOST = 256  # jobs of one portion

Numbered = tuple[int, Job]
Work = Callable[[Job, str], Outcome]


@dataclass(frozen=True)
class Task:
    """What a process does with a portion: `work` on each job for answers below `folder`, names being from the folder `place`."""

    folder: str
    work: Work = perform
    place: str = ""

    def __call__(self, portion: list[Numbered]) -> list[Outcome]:
        """The outcomes, in order."""
        if self.place:
            os.chdir(self.place)
        return [self.work(job, self.folder) for _, job in portion]


def next_size(found: list[Outcome], portion_s: float = _PORTION_S) -> int:
    """Jobs of the next portion of `portion_s` seconds, by how long the last ones took."""
    seconds = sum(0.0 if each.resumed else each.seconds for each in found) / len(found)
    return _MOST if seconds * _MOST <= portion_s else max(1, int(portion_s / seconds))
