"""Which physics: every candidate fitted beside the parameters of the deck, their evidence compared, and what may be said of it."""
