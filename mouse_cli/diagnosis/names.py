"""The names of all that a diagnosis considers: mechanisms, which modes and FRFs show, what only FRFs show, and laws, which
recordings show.
"""

from mouse_cli.diagnosis.likelihoods.candidates import OWN
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.mechanisms import registry as mechanisms
from mouse_cli.model.problem import Problem
from mouse_cli.terms.laws import Law
from mouse_cli.terms.laws import registry as laws
from mouse_cli.updating.recordings.channels import misreadings


def by_records(problem: Problem) -> bool:
    """Whether a deck is judged by its recordings: it has no modes and no FRFs."""
    return bool(problem.recordings) and problem.test is None and not problem.frf


def known() -> dict[str, Candidate | Law]:
    """Everything that has a name, by key; what both kinds of data show as the mechanism."""
    return dict(sorted((by_recordings() | OWN | mechanisms()).items()))


def considered(problem: Problem) -> dict[str, Candidate | Law]:
    """Those that the data of a deck can show."""
    if by_records(problem):
        return by_recordings()
    return dict(sorted((mechanisms() | OWN).items())) if problem.frf else mechanisms()


def by_recordings() -> dict[str, Law]:
    """What recordings show: laws of forces, and errors of their channels."""
    return laws() | misreadings()


def chosen(problem: Problem, given: tuple[str, ...], without: bool) -> tuple[str, ...]:
    """Keys that are considered for a deck: those `given`, or all but these.

    Raises ValueError for a name without meaning for the data of the deck, and where nothing is left.
    """
    own, data = considered(problem), "modes and frequency response functions" if problem.frf else "modes"
    data = "recordings" if by_records(problem) else data
    for name in given:
        if name not in own:
            raise ValueError(f"candidate '{name}' has no meaning for {data}; these have: {', '.join(own)}")
    found = tuple(name for name in own if (name in given) != without)
    if not found:
        raise ValueError(f"no candidate is left; of {data} there are {', '.join(own)}")
    return found


def of_modes(given: tuple[str, ...] | None) -> dict[str, Candidate] | None:
    """The mechanisms among those `given`, by key, which modes show too; None: all."""
    return None if given is None else {key: one for key, one in mechanisms().items() if key in given}


class NoSite(ValueError):
    """None of the candidates that were asked for has a site in the model."""


def housed(model: Reduced, given: tuple[str, ...] | None) -> None:
    """Raises NoSite where none of the mechanisms `given` (None: all) has a site in the model, with those that have one."""
    found, own = mechanisms(), OWN if model.first.problem.frf else {}
    if given is None or any(name in own or model.recipes((OWN | found)[name]) for name in given):
        return
    why = "; ".join(f"{name}: {(OWN | found)[name].why(model.first)}" for name in given)
    others = ", ".join(name for name, each in found.items() if model.recipes(each))
    raise NoSite(f"no requested candidate has a site in this model ({why}); these have one: {others}")
