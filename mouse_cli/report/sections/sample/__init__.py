"""Sections that tell of a sampled posterior."""
