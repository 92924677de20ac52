"""Compliances of an edge crack (`terms.fracture`) one depth at a time, kept: a search asks for the same depth for every bar."""

from functools import cache

from mouse_cli.terms import fracture


@cache
def bending(depth: float) -> float:
    """F1."""
    return float(fracture.bending(depth))


@cache
def coupling(depth: float) -> float:
    """F12."""
    return float(fracture.coupling(depth))


@cache
def stretching(depth: float) -> float:
    """F3."""
    return float(fracture.stretching(depth))


@cache
def shearing(depth: float) -> float:
    """F2."""
    return float(fracture.shearing(depth))
