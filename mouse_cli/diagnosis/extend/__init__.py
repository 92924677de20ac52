"""The deck with the named cause in it: a deck that runs."""
