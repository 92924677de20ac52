"""What has changed in a structure that its model did not explain before either.

What the state before lacks is diagnosed by itself, and put into the decks of all states; what changed is sought with that in them.
"""

from collections.abc import Callable
from dataclasses import replace

from mouse_cli._errors import NumericalError
from mouse_cli.diagnosis.diagnose import by_its_modes
from mouse_cli.diagnosis.extend.deck import extended
from mouse_cli.diagnosis.likelihoods.configurations.checked import checked
from mouse_cli.diagnosis.likelihoods.configurations.compared import compared
from mouse_cli.diagnosis.likelihoods.configurations.diagnose import Decks, diagnose_arrangements, on_short_elements
from mouse_cli.diagnosis.likelihoods.configurations.erring import before as erring
from mouse_cli.diagnosis.likelihoods.measured import Measured
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import explains
from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import NAMED, ONE_OF, Choices, Diagnosis
from mouse_cli.model.problem import Problem

_ALL = Choices()


def diagnose_changes(
    fitted: Decks, unseen: Decks, notice: Callable[[str], None] = lambda text: None, choices: Choices = _ALL
) -> ArrangementsDiagnosis:
    """As `diagnose_arrangements`; where one deck is of the state before, and later tests differ from its own, that is diagnosed by
    itself first, and a change is sought beside what it lacks, if that has a name.

    What the state before lacks is little beside what theory may err, and yet puts a change elsewhere: where a mass is in neither
    model, the next one at the mirror image of its place.
    """
    before = [i for i, has in enumerate(fitted.having) if not has]
    if len(before) != 1:
        return diagnose_arrangements(fitted, unseen, notice, choices)
    checked((*fitted.problems, *unseen.problems))
    fitted, unseen, said = on_short_elements(fitted, unseen)
    tests, state, found = compared(fitted.arranged), None, None
    if tests is not None and not tests.alike:
        notice("what the state before lacks is sought first")
        try:
            state, parts = _of_before(fitted.problems[before[0]], fitted, unseen, notice, choices)
            if parts is not None:
                notice(f"what changed is sought with {state.best.title} in all decks")
                found = diagnose_arrangements(*parts, notice, choices)
        except NumericalError:  # a state that has nothing to do with its model, or decks that are no structures with that in them
            found = None
    if found is None or found.unsought:
        found = diagnose_arrangements(fitted, unseen, notice, choices)
        state = state if found.unsought else None
    return replace(found, state=state, remarks=said + found.remarks)


def _of_before(
    before: Problem, fitted: Decks, unseen: Decks, notice: Callable[[str], None], choices: Choices
) -> tuple[Diagnosis, tuple[Decks, Decks] | None]:
    """What the state before lacks, and the decks with it in them; None where it has no name, or cannot be put into all."""
    asked = erring(fitted.arranged)
    scatters = asked is None or not asked.refused  # more than one mechanism is then no more than what members differ by
    state, verdict = by_its_modes(Measured(before, choices.candidates), notice, replace(choices, causes=1) if scatters else choices)
    put = verdict.put
    if put is None or state.kind not in ((NAMED,) if scatters else (NAMED, ONE_OF)) or not explains(put):
        return state, None
    if put.model.base.problem.structure.n != before.structure.n:
        return state, None  # on shorter elements still, which decks of the others do not have
    parts = [_with(decks, put, verdict.sure) for decks in (fitted, unseen)]
    return state, None if None in parts else tuple(parts)


def _with(decks: Decks, put: Fit, which: tuple[int, ...] | None) -> Decks | None:
    """The same decks with what is certain of a fit of the state before (its mechanisms `which`; None: all) in them; None where
    that cannot be put into all of them. What acts beside it is open, and sought with the change.
    """
    made = [extended(deck, put, which) for deck in decks.problems]
    if None in made:
        return None
    return replace(decks, problems=tuple(replace(deck, parameters=made[0].parameters) for deck in made))
