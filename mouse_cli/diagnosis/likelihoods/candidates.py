"""Physics that only one kind of data can show, beside the candidates of `mechanisms`: what dissipates, in functions."""

from mouse_cli.diagnosis.likelihoods.frf.dashpots import DASHPOT
from mouse_cli.diagnosis.likelihoods.frf.lossy_parts import LOSSY_PART
from mouse_cli.diagnosis.mechanisms import Candidate

OWN: dict[str, Candidate] = {each.key: each for each in (DASHPOT, LOSSY_PART)}
