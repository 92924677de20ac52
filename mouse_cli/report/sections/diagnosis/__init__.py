"""Sections that tell of a diagnosis."""
