"""Causes judged by frequency response functions: places and laws line by line, damping among them."""
