"""What every deck obeys, whatever its format: one file, one part of a deck; `assemble` applies them all."""
