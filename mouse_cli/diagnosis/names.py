"""The names of all that a diagnosis considers: mechanisms, which modes and FRFs show, and laws, which recordings show."""

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
    return dict(sorted((by_recordings() | mechanisms()).items()))


def considered(problem: Problem) -> dict[str, Candidate | Law]:
    """Those that the data of a deck can show."""
    return by_recordings() if by_records(problem) else mechanisms()


def by_recordings() -> dict[str, Law]:
    """What recordings show: laws of forces, and errors of their channels."""
    return laws() | misreadings()


def chosen(problem: Problem, given: tuple[str, ...], without: bool) -> tuple[str, ...]:
    """Keys that are considered for a deck: those `given`, or all but these.

    Raises ValueError for a name without meaning for the data of the deck, and where nothing is left.
    """
    own, data = considered(problem), "recordings" if by_records(problem) else "modes and frequency response functions"
    for name in given:
        if name not in own:
            raise ValueError(f"candidate '{name}' has no meaning for {data}; these have: {', '.join(own)}")
    found = tuple(name for name in own if (name in given) != without)
    if not found:
        raise ValueError(f"no candidate is left; of {data} there are {', '.join(own)}")
    return found


class NoSite(ValueError):
    """None of the candidates that were asked for has a site in the model."""


def housed(model: Reduced, given: tuple[str, ...] | None) -> None:
    """Raises NoSite where none of the mechanisms `given` (None: all) has a site in the model, with those that have one."""
    found = mechanisms()
    if given is None or any(model.recipes(found[name]) for name in given):
        return
    why = "; ".join(f"{name}: {found[name].why(model.first)}" for name in given)
    others = ", ".join(name for name, each in found.items() if model.recipes(each))
    raise NoSite(f"no requested candidate has a site in this model ({why}); these have one: {others}")
