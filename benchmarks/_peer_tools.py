"""Run by the peers' own Python: OpenTURNS or probeye on the problem of a file, around the same model as scipy's baseline.

Usage: _peer_tools.py TOOL FILE.npz; prints a line of JSON: CPU seconds without imports, eigensolutions, theta.
"""

import json
import logging
import sys
import time
import warnings

import numpy as np
from _user_model import UserModel

ARGUMENTS = ("K", "M", "dofs", "f", "f_sd", "shapes", "shape_sd", "prior_sd")


def openturns(model: UserModel):
    """Gaussian calibration by nonlinear least squares, the Laplace approximation of the posterior; a function to be timed."""
    import openturns as ot

    ot.Log.Show(ot.Log.NONE)
    p, q = len(model.prior_sd), len(model.y)
    function = ot.PythonFunction(p + 1, q, lambda x: model.predicted(np.array(x[1:])) / model.sd)
    calibrated = ot.ParametricFunction(function, list(range(1, p + 1)), [1.0] * p)
    prior = ot.CovarianceMatrix(np.diag(model.prior_sd**2))
    noise = ot.CovarianceMatrix(q)
    data = ot.Sample([[0.0]]), ot.Sample([list(model.y / model.sd)])

    def run() -> np.ndarray:
        """The posterior mode."""
        algorithm = ot.GaussianNonLinearCalibration(calibrated, *data, [1.0] * p, prior, noise)
        algorithm.setBootstrapSize(0)
        algorithm.run()
        return np.array(algorithm.getResult().getParameterMAP())

    return run


def probeye(model: UserModel):
    """Maximum likelihood by Nelder and Mead, probeye's own choice; a function to be timed."""
    from loguru import logger
    from probeye.definition.distribution import Normal
    from probeye.definition.forward_model import ForwardModelBase
    from probeye.definition.inverse_problem import InverseProblem
    from probeye.definition.likelihood_model import GaussianLikelihoodModel
    from probeye.definition.sensor import Sensor
    from probeye.inference.scipy.solver import MaxLikelihoodSolver

    logger.remove()
    names = [f"theta{i}" for i in range(len(model.prior_sd))]

    class Forward(ForwardModelBase):
        """The user's model in probeye's terms."""

        def interface(self):
            """What goes in and what comes out."""
            self.parameters = list(names)
            self.input_sensors = Sensor("x")
            self.output_sensors = Sensor("y", std_model="sigma")

        def response(self, inp: dict) -> dict:
            """Predicted data in units of their standard deviations."""
            return {"y": model.predicted(np.array([float(inp[name]) for name in names])) / model.sd}

    problem = InverseProblem("peer", print_header=False)
    for name, sd in zip(names, model.prior_sd, strict=True):
        problem.add_parameter(name, "model", prior=Normal(mean=1.0, std=float(sd)))
    problem.add_parameter("sigma", "likelihood", value=1.0)
    problem.add_experiment("test", sensor_data={"x": np.arange(len(model.y), dtype=float), "y": model.y / model.sd})
    problem.add_forward_model(Forward("model"), experiments="test")
    problem.add_likelihood_model(GaussianLikelihoodModel(experiment_name="test", model_error="additive"))

    def run() -> np.ndarray:
        """The maximum of the likelihood."""
        return np.array(MaxLikelihoodSolver(problem, show_progress=False).run().x)

    return run


def main() -> None:
    """Time one tool on one file."""
    warnings.simplefilter("ignore")
    logging.disable(logging.WARNING)
    tool, path = sys.argv[1:]
    with np.load(path) as file:
        model = UserModel(*(file[name] for name in ARGUMENTS))
    run = {"OpenTURNS": openturns, "probeye": probeye}[tool](model)
    start = time.process_time()
    theta = run()
    print(json.dumps({"cpu": time.process_time() - start, "solutions": model.solutions, "theta": theta.tolist()}))


if __name__ == "__main__":
    main()
