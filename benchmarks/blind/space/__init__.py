"""Blind cases of space frames and storey buildings: truths by OpenSees (`pip install openseespy`), decks without the cause."""
