"""Sections that tell of an identification."""
