"""Structures as input files of CalculiX, imported by mouse import, with a change concealed in the solver's input."""
