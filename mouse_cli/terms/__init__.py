"""One file, one kind of term: a parameterised contribution to the equations of motion."""
