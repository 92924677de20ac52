"""The model before the test, as Tables 5-2 and 5-3 print it: stiffness, mass, prior covariance, [A] (items 1, 2, 4 and 5)."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.arrays import dense
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Matrix
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import names


def matrices_before(result: Result, options: Options) -> Iterator[Block]:
    """K, M, S and [A] (elements by properties) of a small model of matrices; elements of a structure have no [A]."""
    problem = result.problem
    if problem.terms or problem.structure.n > options.matrix_dofs or len(problem.parameters) > options.properties:
        return
    dofs, properties = problem.structure.labels, names(problem)
    yield Matrix("stiffness matrix before optimization", dense(result.prior.K), dofs, dofs)
    yield Matrix("mass matrix before optimization", dense(result.prior.M), dofs, dofs)
    cov = problem.prior.cov
    if cov.ndim == 1 or not (cov - np.diag(np.diag(cov))).any():  # what is correlated stands above
        yield Matrix(
            "covariance S of the properties before optimization", problem.prior.dense(), properties, properties
        )
    yield Matrix("[A], elements by properties", dense(problem.A), problem.elements.labels(), properties)


SECTION = Section(
    "matrices-before", 35, "Stiffness and mass matrices before optimization", matrices_before, place=APPENDIX
)
