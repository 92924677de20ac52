"""What the commands do with more than one deck or with files of measured data, as functions of Python."""
