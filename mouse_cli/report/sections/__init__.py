"""One file, one section of the report: what it is called, where it stands, and the blocks it says."""
