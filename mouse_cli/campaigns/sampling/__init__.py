"""The posterior of a deck by samples, and whether the normal density that a run reports may stand for it. See `mouse sample`."""
