"""Numerics on arrays, no input or output: eigensolution, sensitivities, correlation of mode shapes."""
