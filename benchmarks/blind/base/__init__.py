"""The blind benchmark of base excitation: storey buildings on a shake table, truths from OpenSees."""
