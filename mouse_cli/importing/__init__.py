"""Input files of finite-element programs: read, exported by the solver itself, and written as a deck that runs."""
