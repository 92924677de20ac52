"""All that a deck has measured: modes, or those that its FRFs show, with FRFs and recordings beside them, or recordings alone.

Kinds of data are independent of one another, so that the log evidence of one adds to that of another: hypotheses are ranked by
modes, then by FRFs too, then by recordings too. Nothing outside of this folder asks which kinds there are.
"""

from collections.abc import Callable
from copy import copy
from dataclasses import replace

from mouse_cli.diagnosis.likelihoods.frf.calibrated import miscalibrated
from mouse_cli.diagnosis.likelihoods.frf.compared import compared
from mouse_cli.diagnosis.likelihoods.frf.compared import remarks as of_windows
from mouse_cli.diagnosis.likelihoods.frf.deck import with_damping
from mouse_cli.diagnosis.likelihoods.frf.identified import with_modes
from mouse_cli.diagnosis.likelihoods.frf.rank import ByFunctions
from mouse_cli.diagnosis.likelihoods.history.diagnose import diagnose_records
from mouse_cli.diagnosis.likelihoods.history.rank import ByRecordings
from mouse_cli.diagnosis.names import by_records
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.model.diagnosis import Choices, Diagnosis
from mouse_cli.model.problem import Problem

Notice = Callable[[str], None]


class Measured:
    """The data of `given`. problem: the deck with the modes that are searched with; doubts: what speaks against modes of FRFs.
    candidates: keys of what is considered; None: all.

    Raises NumericalError (MD680) where FRFs alone are given and show no mode.
    """

    def __init__(self, given: Problem, candidates: tuple[str, ...] | None = None):
        self.given = given
        self.problem, self.doubts = (given, ()) if by_records(given) else with_modes(given)
        self._by_functions, self._by_recordings = ByFunctions(candidates), ByRecordings()

    def of(self, do: Callable[[Problem], Problem]) -> "Measured":
        """The same data of what `do` makes of the deck."""
        same = copy(self)
        same.given = do(self.given)
        same.problem = same.given if self.problem is self.given else do(self.problem)
        return same

    @property
    def modes(self) -> bool:
        """Whether modes were measured; else those of `problem` are the FRFs' own."""
        return self.given.test is not None

    def ranked(self, by_modes: Ranking) -> Ranking:
        """A ranking by modes, by FRFs and recordings too."""
        return self._by_recordings(self._by_functions(by_modes, self.modes))

    def laws(self, notice: Notice, choices: Choices) -> Diagnosis | None:
        """What recordings say of laws of forces: of a deck of these alone, or where `ranked` found that they ask for
        more than a linear mechanism; None of others.
        """
        if by_records(self.given):
            return diagnose_records(self.given, notice, choices)
        left = self._by_recordings.unexplained
        return None if left is None else diagnose_records(self.given, notice, choices, left)

    def remarks(self, ranking: Ranking) -> tuple[str, ...]:
        """What a ranking found out about the data."""
        return (*of_windows(ranking), *getattr(ranking, "remarks", ()))

    def cautions(self, one: Fit) -> tuple[str, ...]:
        """What the explanation `one` says against the data, in sentences of the verdict."""
        return miscalibrated(one)

    def compared(self, ranking: Ranking, best: Fit | None) -> dict[str, object]:
        """Fields of a Diagnosis: FRFs of the model as it is and of the fit `best` beside those measured, and damping."""
        return vars(compared(self.problem, ranking, best))

    def extended(self, deck: Problem, one: Fit) -> Problem:
        """`deck`, which has the mechanisms of the fit `one`, with what the data say of its damping, and the test that was given."""
        return with_damping(replace(deck, test=self.given.test and deck.test), self.problem, one)
