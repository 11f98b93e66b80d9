//! Arguments for the range and the signal of a force transducer, which its protocol does not report.

use taceva_core::{ArgSpec, Args, ForceFacts, Newton};

use super::{fact, optional_number};

/// Key of the measuring range, N.
pub(crate) const FORCE_MAX: &str = "force_max_n";
const RESOLUTION: &str = "resolution_n";
const NOISE: &str = "noise_n";

/// Arguments for facts that no transducer protocol reports.
pub(crate) fn force_facts() -> [ArgSpec; 3] {
    [
        fact(
            FORCE_MAX,
            [0.001, 100_000.0],
            "smallest measuring range of its forces, N, from its certificate",
        ),
        fact(
            RESOLUTION,
            [1e-9, 1_000.0],
            "step between neighbouring force readings, N",
        ),
        fact(
            NOISE,
            [1e-9, 1_000.0],
            "noise of force readings at constant load, N: one standard deviation, as measured",
        ),
    ]
}

/// Sets the facts from the arguments of [`force_facts`].
pub(crate) fn add_facts_of_force(args: &Args, facts: &mut ForceFacts) {
    let force = |key| optional_number(args, key).map(Newton);
    facts.force_max = force(FORCE_MAX);
    facts.resolution = force(RESOLUTION);
    facts.noise = force(NOISE);
}
