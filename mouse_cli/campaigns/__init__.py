"""Many runs of one deck: sweeps over assumptions, bootstrap of the test, samples of the posterior."""
