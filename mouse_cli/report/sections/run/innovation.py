"""Before the cycles: could this model, as uncertain as it is said to be, have given these data?"""

from collections.abc import Iterator

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import chance, test_table


def innovation(result: Result, options: Options) -> Iterator[Block]:
    """The test and one sentence."""
    test = result.innovation
    yield test_table((test,))
    if test.dof == 0:
        yield Text("The data leave nothing to test.")
    elif test.rejects:
        yield Text(
            f"The prior model does not foresee these data: by chance they would lie so far from it {chance(test.p)}. The form of "
            "the model, the prior standard deviations or the accuracies of the test are wrong, or the differences are too large "
            "for first-order partial derivatives."
        )
    else:
        yield Text(
            f"The data lie no farther from the prior model than its uncertainty and the accuracies of the test let expect: by "
            f"chance they would lie farther {chance(test.p)}."
        )


SECTION = Section("innovation", 40, "Test against prior model", innovation)
