//! Checks of a plugin's library as a whole.

#![expect(
    unsafe_code,
    reason = "the test calls functions of the library with arguments that no host passes"
)]

use taceva_abi as abi;

use super::subject::Subject;
use super::surroundings::Surroundings;
use super::{Check, Of};
use crate::promise::{Unmet, broken, expect, skipped};
use taceva_host::Library;
use taceva_host::bare::RigHandle;

/// Name of the check that fails if its child process prints anything.
pub(super) const QUIET: &str = "library/quiet";

const OF: Of = Of::Plugin;

pub(super) const CHECKS: &[Check] = &[
    OF.check("library/loads", |_| Ok(())),
    OF.check("library/loads-twice", loads_twice),
    OF.check("library/ends", ends),
    OF.check("library/needs-what-its-manifest-says", needs),
    OF.check("library/unknown-factory", unknown_factory),
    OF.check("library/stable-factories", stable_factories),
    OF.check("library/rigs", rigs),
    OF.check("library/unknown-rig-extension", unknown_rig_extension),
    OF.check("library/keeps-surroundings", keeps_surroundings),
    OF.check("library/keeps-signals", keeps_signals),
    OF.check(QUIET, quiet),
];

fn load(subject: &Subject) -> Result<std::sync::Arc<Library>, Unmet> {
    let manifest = Some(&subject.manifest);
    let loaded = subject.source.load(manifest, Box::new(|_, _, _| {}));
    loaded.map_err(|error| Unmet::Broken(error.problem().to_string()))
}

/// A second copy of the library loads, and states the same id as the first copy.
fn loads_twice(subject: &Subject) -> Result<(), Unmet> {
    let second = load(subject)?;
    expect(second.id() == subject.library.id(), || {
        "another id".to_owned()
    })
}

/// The plugin's function `deinit` succeeds after all objects are closed. The library can then be initialised again.
fn ends(subject: &Subject) -> Result<(), Unmet> {
    drop(load(subject)?);
    drop(load(subject)?);
    Ok(())
}

/// The manifest contains all external needs that the library states, since the host reads only the manifest.
fn needs(subject: &Subject) -> Result<(), Unmet> {
    let offer = subject.library.offer();
    let offer = offer.map_err(|problem| Unmet::Broken(problem.to_string()))?;
    if offer.needs.is_empty() {
        let why = "the library states no needs";
        return Err(Unmet::Skipped(why.to_owned()));
    }
    let written = &subject.manifest.needs;
    let is_missing = |need: &&String| !written.iter().any(|written| written.to_string() == **need);
    match offer.needs.iter().find(is_missing) {
        None => Ok(()),
        Some(need) => Err(Unmet::Broken(format!(
            "it states the need {need:?}, but its manifest does not; add it with `taceva plugin manifest --write`"
        ))),
    }
}

fn factory(subject: &Subject, id: abi::Text) -> Result<usize, Unmet> {
    let factory = subject.library.plugin().factory;
    let factory = factory.ok_or_else(|| broken("`factory` is NULL"))?;
    // SAFETY: [any], after `init`, with a text that outlives the call.
    Ok(unsafe { factory(id) }.addr())
}

fn unknown_factory(subject: &Subject) -> Result<(), Unmet> {
    let long = "taceva.sensor/1".repeat(500);
    for id in [
        "",
        "taceva.sensor/2",
        "taceva.sensor/",
        "Taceva.sensor/1",
        &long,
    ] {
        let found = factory(subject, abi::Text::from(id))?;
        expect(found == 0, || {
            format!(
                "it returned a factory for the unknown id {:?}",
                &id[..id.len().min(40)]
            )
        })?;
    }
    let nothing = abi::Text {
        data: std::ptr::null(),
        length: 0,
    };
    expect(factory(subject, nothing)? == 0, || {
        "it returned a factory for an empty id".to_owned()
    })
}

fn stable_factories(subject: &Subject) -> Result<(), Unmet> {
    for id in [
        abi::SENSOR_FACTORY,
        abi::ROBOT_FACTORY,
        abi::FORCE_FACTORY,
        abi::LIGHTING_FACTORY,
        abi::CHANGER_FACTORY,
        abi::ESTIMATOR_FACTORY,
    ] {
        let once = factory(subject, abi::Text::from(id))?;
        let again = factory(subject, abi::Text::from(id))?;
        expect(once == again, || format!("the address of `{id}` changes"))?;
    }
    Ok(())
}

fn rigs(subject: &Subject) -> Result<(), Unmet> {
    let together: Vec<_> = (0..32)
        .map(|_| RigHandle::open(&subject.library))
        .collect::<Result<_, _>>()?;
    drop(together);
    for _ in 0..200 {
        drop(RigHandle::open(&subject.library)?);
    }
    Ok(())
}

fn unknown_rig_extension(subject: &Subject) -> Result<(), Unmet> {
    let Some(extension) = subject.library.plugin().rig_extension else {
        return Err(skipped("its rigs have no extensions"));
    };
    let rig = RigHandle::open(&subject.library)?;
    // SAFETY: [owner] of an open rig, with a text that outlives the call.
    let found = unsafe { extension(rig.raw(), abi::Text::from("taceva.nothing/1")) };
    expect(found.is_null(), || {
        "it returned a table for an unknown extension".to_owned()
    })
}

/// Loading the library and opening a device change neither the working directory nor the environment.
fn keeps_surroundings(subject: &Subject) -> Result<(), Unmet> {
    drop(RigHandle::open(&subject.library)?);
    let (before, now) = (&subject.before, Surroundings::now());
    let is_kept = before.folder == now.folder && before.variables == now.variables;
    expect(is_kept, || {
        "the working directory or the environment has changed".to_owned()
    })
}

fn keeps_signals(subject: &Subject) -> Result<(), Unmet> {
    drop(RigHandle::open(&subject.library)?);
    let now = Surroundings::now().handlers;
    let mut pairs = subject.before.handlers.iter().zip(&now);
    match pairs.position(|(before, now)| before != now) {
        None => Ok(()),
        Some(place) => Err(Unmet::Broken(format!(
            "the handler of signal {} has changed",
            place + 1
        ))),
    }
}

/// Loading the library prints nothing, because its output would corrupt the output of the program. The host checks the output of the process.
fn quiet(subject: &Subject) -> Result<(), Unmet> {
    drop(load(subject)?);
    drop(RigHandle::open(&subject.library)?);
    Ok(())
}
