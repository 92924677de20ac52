"""From recordings to measured data with their covariance: spectra, modal identification, signs of nonlinearity."""
