"""Detection: are model and test consistent, before and after the update of the model as it is?"""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import NOTHING, Diagnosis
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import test_table


def detection(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The three tests of `run`, and what the noise had to be raised to."""
    result = found.result
    yield test_table((found.innovation, result.residual, result.prior_shift))
    yield Text(f"The model as it is: {result.status.sentence} Form of the model: {result.model_form}.")
    if found.noise_scale > 1 and found.kind != NOTHING:
        yield Text(
            f"The best explanation leaves {found.noise_scale:.3g} times the variance that the test states, and the evidence is "
            "computed with variances larger by that factor. Far above 1, the test is less accurate than stated, or the explanation "
            "is incomplete."
        )


SECTION = Section("diagnosis-detection", 30, "Model against test", detection, (Diagnosis,))
