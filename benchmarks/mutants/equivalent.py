"""Faults of `sampled` that change no answer, each with the reason; by their keys."""

EQUIVALENT: dict[str, str] = {}
