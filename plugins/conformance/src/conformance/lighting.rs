//! The suite for lightings, and its part for sensors that can set the light around them.

use taceva_core::{Deadline, ErrorKind, Factory, Facts, Lighting};

use super::bench::{Bench, Test, Unmet, answered, broken, expect, refused, run};
use super::{Report, Trial};

/// Tries a lighting.
pub fn lighting(factory: &dyn Factory<dyn Lighting>, trial: &Trial) -> Report {
    run(factory, trial, TESTS)
}

const TESTS: &[Test<dyn Lighting>] = &[
    ("has the scenes it declares", |bench| {
        let declared = match bench.descriptor.facts() {
            Facts::Lighting(facts) => &facts.scenes,
            other => return Err(broken(format!("declares a {}", other.kind()))),
        };
        has_scenes(bench.open()?.as_ref(), declared)
    }),
    ("sets each of its scenes, and no other", |bench| {
        sets_scenes(bench, bench.open()?.as_mut())
    }),
    ("answers a deadline that has passed at once", |bench| {
        let mut lighting = bench.open()?;
        let scene = lighting.scenes()[0].clone();
        let set = bench.at_once("setting a scene", || lighting.set(&scene, Deadline::PASSED))?;
        answered("setting a scene without time", set, ErrorKind::Timeout)
    }),
];

pub(super) fn has_scenes(lighting: &dyn Lighting, declared: &[String]) -> Result<(), Unmet> {
    expect(lighting.scenes() == declared, || {
        format!("has {:?}, declares {declared:?}", lighting.scenes())
    })
}

pub(super) fn sets_scenes<D: ?Sized>(
    bench: &Bench<'_, D>,
    lighting: &mut dyn Lighting,
) -> Result<(), Unmet> {
    for scene in lighting.scenes().to_vec() {
        lighting.set(&scene, bench.trial.deadline)?;
    }
    let stranger = format!("not {}", lighting.scenes().join(" nor "));
    let set = lighting.set(&stranger, bench.trial.deadline);
    refused(
        "setting an unknown scene",
        set,
        &[ErrorKind::InvalidArgument],
    )
}
