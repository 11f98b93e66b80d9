//! Promises of lighting devices, and of sensors that control their lighting.

use taceva_core::{Deadline, ErrorKind, Factory, Facts, Lighting};

use crate::promise::{Unmet, answered, broken, expect, refused};
use crate::report::Report;
use crate::trial::{Promise, Trial, Tried, report};

/// Tests the promises of a lighting device with the settings of `trial`.
pub fn lighting(factory: &dyn Factory<dyn Lighting>, trial: &Trial) -> Report {
    report(factory, trial, PROMISES)
}

pub(crate) const PROMISES: &[Promise<dyn Lighting>] = &[
    ("lighting/has-the-scenes-it-says", |tried| {
        has_scenes(&*tried.open()?, declared(tried)?)
    }),
    ("lighting/sets-each-scene", |tried| {
        let mut lighting = tried.open()?;
        sets_scenes(tried, &mut *lighting)?;
        sets_scenes(tried, &mut *lighting)
    }),
    ("lighting/refuses-other-scenes", |tried| {
        refuses_stranger(tried, &mut *tried.open()?)
    }),
    ("lighting/passed-deadline", passed_deadline),
];

fn declared<'a>(tried: &'a Tried<'_, dyn Lighting>) -> Result<&'a [String], Unmet> {
    match tried.descriptor.facts() {
        Facts::Lighting(facts) => Ok(&facts.scenes),
        other => Err(broken(format!("declares itself a {}", other.kind()))),
    }
}

pub(crate) fn has_scenes(lighting: &dyn Lighting, declared: &[String]) -> Result<(), Unmet> {
    expect(lighting.scenes() == declared, || {
        format!(
            "it has the scenes {:?}, but declares {declared:?}",
            lighting.scenes()
        )
    })
}

pub(crate) fn sets_scenes<D: ?Sized>(
    tried: &Tried<'_, D>,
    lighting: &mut dyn Lighting,
) -> Result<(), Unmet> {
    for scene in lighting.scenes().to_vec() {
        lighting.set(&scene, tried.trial.deadline)?;
    }
    Ok(())
}

pub(crate) fn refuses_stranger<D: ?Sized>(
    tried: &Tried<'_, D>,
    lighting: &mut dyn Lighting,
) -> Result<(), Unmet> {
    let stranger = format!("not {}", lighting.scenes().join(" nor "));
    let set = lighting.set(&stranger, tried.trial.deadline);
    refused("an unknown scene", set, &[ErrorKind::InvalidArgument])
}

fn passed_deadline(tried: &Tried<'_, dyn Lighting>) -> Result<(), Unmet> {
    let mut lighting = tried.open()?;
    for scene in lighting.scenes().to_vec() {
        let doing = "setting a scene without time";
        let set = tried.at_once(doing, || lighting.set(&scene, Deadline::PASSED))?;
        answered(doing, set, ErrorKind::Timeout)?;
    }
    Ok(())
}
