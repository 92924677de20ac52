"""The deck with the laws that recordings show: springs, dashpots, masses and oscillators as parameters, the others as laws."""

import re
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.deck import in_its_units
from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.extend.points import Ends, add_dashpot, add_mass, add_oscillator, add_spring, remove_mass
from mouse_cli.diagnosis.extend.renumbered import moved_channels
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.local_law import LocalLaw
from mouse_cli.model.problem import Problem
from mouse_cli.updating.recordings.acting import Part
from mouse_cli.updating.recordings.channels import Misreading
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.places import bodies


def extended(problem: Problem, best: Fit) -> Problem | None:
    """The deck with the causes of a fit in it: laws, and what is linear as parameters; None where one cannot be put into a deck."""
    deck, laws = problem, list(problem.laws)
    for part, values in best.hypothesis.sizes(best.x[None]):
        if isinstance(part.law, Misreading):
            return None
        if part.law.listed:
            laws.append(_law(part, values[:, 0], problem.structure.labels))
            continue
        deck = with_linear(deck, part, values[:, 0])
        if deck is None:
            return None
    deck = in_its_units(deck, len(problem.parameters))
    return replace(deck, laws=tuple(_moved(one, problem, deck) for one in laws))


def with_linear(problem: Problem, part: Part, p: np.ndarray) -> Problem | None:
    """The deck with a linear law at its place, of parameters p (q,); None where the deck cannot hold it.

    What is lost is a negative spring or, in a model of matrices, a negative mass. Where damping is assumed, as a deck has none, a
    dashpot would be all of it.
    """
    law, labels = part.law.key, _labels(problem, part.place.site)
    bare = problem.structure.C is None and problem.modal_damping is None
    if of_matrices(problem) and bare and law in ("dashpot", "oscillator"):
        return None
    numbers = [int(re.match(r"\d+", label)[0]) for label in labels if not of_matrices(problem)]
    dofs = tuple(problem.structure.labels.index(label) for label in labels)
    ends, at = Ends(dofs, lambda edit: [edit.index(i) for i in numbers], labels[0][-2:]), " and ".join(labels)
    if law == "spring":
        name = f"stiffness {part.law.words[part.variant]} at {at}"
        deck = add_spring(problem, ends, name, p[0], part.words["sign"])
    elif law == "negative-spring":
        deck = add_spring(problem, ends, f"negative stiffness at {at}", p[0], -1.0)
    elif law == "dashpot":
        deck = add_dashpot(problem, ends, f"dashpot at {at}", p[0])
    elif law == "mass":
        deck = add_mass(problem, dofs, lambda edit: edit.index(numbers[0]), f"mass at {at}", p[0])
    elif law == "mass-loss":
        deck = remove_mass(problem, dofs, lambda edit: edit.index(numbers[0]), f"mass lost at {at}", p[0])
    else:
        w = 2 * np.pi * p[1]  # k = m w^2, c = 2 zeta m w
        names = f"hidden mass at {at}", f"spring of the hidden mass at {at}"
        deck = add_oscillator(problem, ends, names, p[0], float(p[0] * w**2), float(2 * p[2] * p[0] * w))
    held = problem.held_records
    if deck is None or held is None or of_matrices(problem):
        return deck
    to = np.array([deck.structure.labels.index(label) for label in problem.structure.labels])
    return replace(
        deck, held_records=replace(held, recordings=tuple(moved_channels(one, to) for one in held.recordings))
    )


def _labels(problem: Problem, site: Site) -> tuple[str, ...]:
    """Of the degrees of freedom of a site: of a body all by which it translates."""
    if site.kind != "node":
        return site.ids
    own = next(own for one, own in bodies(problem) if one == site)
    return tuple(problem.structure.labels[i] for i in own)


def _law(part: Part, p: np.ndarray, labels: tuple[str, ...]) -> LocalLaw:
    sizes = {size.name: float(value) for size, value in zip(part.unknowns, p, strict=True)}
    motion = part.place.motion
    dofs = tuple(int(i) for i in np.argsort(motion) if motion[i])
    if part.law.motions > 1:  # in the order of its site, which its spin is about
        dofs = tuple(labels.index(label) for label in part.place.site.ids)
    return LocalLaw(part.law.key, part.law.words[part.variant], dofs, sizes)


def _moved(one: LocalLaw, old: Problem, new: Problem) -> LocalLaw:
    """A law at the degrees of freedom of a deck that has changed."""
    place = {label: i for i, label in enumerate(new.structure.labels)}
    return replace(one, dofs=tuple(place[old.structure.labels[i]] for i in one.dofs))
