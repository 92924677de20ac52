"""Sections that tell of an answer of several arrangements."""
