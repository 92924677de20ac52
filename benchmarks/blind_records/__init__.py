"""The blind benchmark of diagnosis by recordings: truths from OpenSees, answers in files that mouse never reads."""
