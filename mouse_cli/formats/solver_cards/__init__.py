"""Include files of finite-element programs: one module = one program; here, what each of them is given."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from mouse_cli import _registry
from mouse_cli.model.revision import RevisedMass, Revision


@dataclass(frozen=True, slots=True)
class SolverFormat:
    """A program: write(revision) gives the text of its include file.

    whole: a material stands in it with all its constants, so that they must be known.
    """

    key: str
    write: Callable[[Revision], str]
    whole: bool = True


def programs() -> dict[str, Any]:
    """All of them by key."""
    return _registry.discover(__name__, "PROGRAM")


def head(revision: Revision, comment: str) -> Iterator[str]:
    """The lines that say what the file is, and what of the revision it does not hold."""
    yield f"{comment} Written by mouse: {revision.title} ({revision.source})"
    yield f"{comment} units: {revision.units or 'those of the deck'}; new elements count from {revision.first}"
    parts = (part.note for part in (*revision.sets, *revision.supports, *revision.thicknesses))
    yield from (f"{comment} not written: {line}" for line in (*revision.unwritten, *parts))


def off_node(mass: RevisedMass, comment: str) -> Iterator[str]:
    """A line for what only Nastran's card of a point mass has: a vector from its node, products of inertia."""
    if any(mass.offset) or any(mass.products):
        off, products = (", ".join(map(number, each)) for each in (mass.offset, mass.products))
        yield f"{comment} not written: it is off its node by {off}, its products of inertia are {products}"


def number(value: float) -> str:
    """A real number with a point, to 10 digits, as all of these programs read it."""
    text = f"{value:.10g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa if '.' in mantissa else mantissa + '.'}E{int(exponent):+03d}"
    return text if "." in text else f"{text}."


def tag(name: str, used: set[str]) -> str:
    """A name of letters, digits and _ for a set, each once."""
    plain = "".join(c if c.isalnum() and c.isascii() else "_" for c in name.upper())[:60].strip("_") or "SET"
    plain = plain if plain[0].isalpha() else f"S_{plain}"
    found, count = plain, 2
    while found in used:
        found, count = f"{plain}_{count}", count + 1
    used.add(found)
    return found
