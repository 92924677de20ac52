"""Bulk data of bars, rods, masses, springs and rigid elements alone, as a deck of mouse's own elements: no solver is needed."""
