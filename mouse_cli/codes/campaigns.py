"""MD550 and MD930 to MD959: what a posterior is worth, sweeps, bootstraps and samples."""

from mouse_cli.codes import Code

CODES = {
    "MD550": Code(
        "posterior that is not normal",
        "A run reports the mode of the posterior and the standard deviations of the normal density that first-order partial "
        "derivatives put there. Two standard deviations from the mode, along the axis that changes a property by the largest "
        "share of its value, the posterior is narrower or wider than that density by a factor of 1.5 or more: so are its "
        "intervals. It is looked at where that costs little: converged runs of the anchored recursion with a prior, whose model "
        "is not rejected, with dense matrices of up to 30 degrees of freedom.",
        "`mouse sample` gives the posterior as it is. Where the data hardly determine a property, measure what it moves.",
    ),
    "MD930": Code(
        "answer that depends on what was varied",
        "Over the points of a sweep the revised value of the property moves by more than its posterior standard deviation: the "
        "assumptions that were varied matter more than the errors of the test.",
        "Find out what was varied, or state the answer with the spread of the sweep.",
    ),
    "MD931": Code(
        "runs without an answer",
        "Some runs of a sweep or a bootstrap ended without an answer: values beyond limits, models that are not physical, too "
        "few data left. They are left out of the summary.",
        "See their codes; vary over a narrower range, or draw fewer at a time.",
    ),
    "MD932": Code(
        "nothing that can be varied",
        "A name of `--vary` is no option of `mouse run`, no property of the deck (`k1`: its prior value, `k1.sd`: its prior "
        "standard deviation), not `frequency_sd*` or `shape_sd*` (factors of all accuracies), and no path of a single value in "
        "the YAML deck, such as `test.modes.shape_sd` or `model.nodes[3].x`.",
        "Check the name; keys of the deck are joined by points, items of lists are called by their `name` or by number, from 1.",
    ),
    "MD933": Code(
        "value that cannot be taken",
        "A value of `--vary` cannot stand there: a standard deviation or a factor that is not above zero, a prior standard "
        "deviation of a property that may not vary, a text that is no number or word.",
        "Give values such as `0.5,1,2`, or a range `low:high:count`, `log:low:high:count`.",
    ),
    "MD934": Code(
        "nothing to draw",
        "A bootstrap draws measured modes, sensors, functions or stretches of recordings of 300 samples at least: two of each "
        "kind. It is refused for an estimator that does not weight its data, where nothing can count twice.",
        "State in `--over` what the test has two of: with one sensor `--over modes`.",
    ),
    "MD935": Code(
        "no answer to begin from",
        "The run of the deck as it is has no answer, so that it has no scatter to estimate.",
        "Check the deck with `mouse run`.",
    ),
    "MD936": Code(
        "data that disagree among themselves",
        "Results of resampled modes or sensors scatter much more than the stated accuracies account for (p < 0.005 for "
        "their number): the data disagree among themselves, the model errs, or the accuracies are "
        "stated too small. Posterior standard deviations are then too small as well.",
        "Check the data of largest influence; state larger standard deviations; see whether the form of the model is "
        "rejected.",
    ),
    "MD937": Code(
        "accuracies stated too large",
        "Results of resampled modes or sensors scatter much less than the stated accuracies account for (p < 0.005): "
        "the data agree better than stated.",
        "State smaller standard deviations if the test justifies them; errors that all data share do not show in this.",
    ),
    "MD938": Code(
        "answer that rests on one measurement",
        "Without that mode or sensor a property moves by more than its posterior standard deviation.",
        "Check that measurement; repeat it.",
    ),
    "MD940": Code(
        "no package for samples",
        "`mouse sample` walks with the package emcee, which a plain installation does not bring.",
        "`pip install 'mouse-cli[sampling]'`.",
    ),
    "MD941": Code(
        "no posterior to sample",
        "The deck lets no property vary, holds no data, or its run has no answer to begin from.",
        "Check the deck with `mouse run`.",
    ),
    "MD942": Code(
        "normal density that cannot stand for the posterior",
        "Draws from the normal density of the run were weighted by the true posterior. The tail of the weights is so heavy "
        "(Pareto k-hat above 0.7) that no practicable number of draws would give its mean (Vehtari et al. 2024; Yao et al. "
        "2018).",
        "Use the samples, and not the standard deviations of `mouse run`.",
    ),
    "MD943": Code(
        "posterior with several modes",
        "Begun from other values of the prior, the search ends elsewhere, and nearly as high: the data and the prior allow "
        "several answers, such as two springs exchanged. `mouse run` reports one of them.",
        "Measure what separates them (mode shapes, a mass added on one side), or state in the prior what is known.",
    ),
    "MD944": Code(
        "chain too short",
        "The walkers took fewer than 50 autocorrelation times, or do not agree (R-hat of 1.05 or more): quantiles of the "
        "samples are not those of the posterior yet.",
        "Allow more `--steps`. Where that does not help, the posterior has modes between which walkers seldom move.",
    ),
    "MD945": Code(
        "mean or spread of samples other than those of the run",
        "The mean of the samples of a property lies more than half a standard deviation from the value of the run, or their "
        "standard deviation is larger or smaller by a quarter.",
        "Use the samples, and not the standard deviations of `mouse run`.",
    ),
}
