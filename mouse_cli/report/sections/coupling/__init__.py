"""Sections that tell of coupled and modified structures."""
