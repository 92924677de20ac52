"""Many runs of one deck: sweeps of what is not known exactly, bootstraps of the test, samples of the posterior."""
