"""From recordings to measured data with their covariance: spectra, modal identification, nonlinearity indicators."""
