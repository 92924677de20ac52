"""Factors of an edge crack (`terms.fracture`) one depth at a time, kept: a search asks for the same depth for every bar."""

from functools import cache

from mouse_cli.terms import fracture


@cache
def factors(depth: float) -> fracture.Compliance:
    """F1, F2, F3 and F12 in the places of what they make."""
    return fracture.Compliance(*map(float, fracture.factors(depth)))
