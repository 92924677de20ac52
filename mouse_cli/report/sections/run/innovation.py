"""Before the cycles: are the data consistent with the prediction of the prior model and its uncertainty?"""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import p_value
from mouse_cli.report.sections._wording import test_table


def innovation(result: Result, options: Options) -> Iterator[Block]:
    """The test and one sentence."""
    test = result.innovation
    yield test_table((test,))
    if test.dof == 0:
        yield Text("The data leave nothing to test.")
    elif test.rejects:
        yield Text(
            f"The data are inconsistent with the prediction of the prior model ({p_value(test.p)}). The form of the model, prior "
            "standard deviations or the accuracies of the test are wrong, or the differences are too large for first-order "
            "partial derivatives."
        )
    else:
        yield Text(
            "The data are consistent with the prediction of the prior model, its uncertainty and the accuracies of the test "
            f"({p_value(test.p)})."
        )


SECTION = Section("innovation", 40, "Test against prior model", innovation)
