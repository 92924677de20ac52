"""Sections that tell of methods side by side."""
