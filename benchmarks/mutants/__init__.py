"""Small faults put into the engine of diagnosis, one at a time, each of which its tests must notice."""
