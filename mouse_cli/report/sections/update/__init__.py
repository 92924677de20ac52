"""Sections that tell of an update by a method."""
