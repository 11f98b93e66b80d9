//! Arguments for the range, resolution and noise of a force transducer. Its protocol does not report them.

use taceva_core::{ArgSpec, Args, ForceFacts, Newton};

use super::{fact, optional_number};

/// Key of the argument for the smallest measuring range of the forces, N.
pub(crate) const FORCE_MAX: &str = "force_max_n";
const RESOLUTION: &str = "resolution_n";
const NOISE: &str = "noise_n";

/// Arguments for the range, resolution and noise of a transducer, N. No transducer protocol reports them.
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

/// Sets range, resolution and noise in `facts` from the arguments of [`force_facts`]. An absent argument sets `None`.
pub(crate) fn add_facts_of_force(args: &Args, facts: &mut ForceFacts) {
    let force = |key| optional_number(args, key).map(Newton);
    facts.force_max = force(FORCE_MAX);
    facts.resolution = force(RESOLUTION);
    facts.noise = force(NOISE);
}
