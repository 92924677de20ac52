"""The model as the deck has it, in few coordinates, and the same with causes added."""
