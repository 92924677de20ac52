"""What causes do to stiffness, to mass and to what sensors read."""
