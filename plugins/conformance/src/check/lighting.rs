//! Checks of lightings.

#![expect(
    unsafe_code,
    reason = "the functions of the device are called as no host does"
)]

use taceva_abi as abi;
use taceva_core::{DriverKind, ErrorKind, Facts};

use super::subject::{Draw, Ending, PATIENT, SOON, Subject, ensure, expect_failure, timed};
use super::{Check, Of};
use taceva_host::bare::timeout;

pub(super) const CHECKS: &[Check] = &[
    check("lighting/sets-each-scene", sets_each),
    check("lighting/refuses-other-scenes", refuses_others),
    check("lighting/passed-deadline", passed_deadline),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Lighting),
        run,
    }
}

type Lamp = taceva_host::bare::Opened<abi::LightingCalls>;

fn set(lamp: &Lamp, scene: abi::Text, within: u64) -> Result<(), taceva_core::DriverError> {
    let set = lamp.handle.needs(lamp.calls.set, "set")?;
    lamp.handle.call("set the light", |raw, error| {
        // SAFETY: [owner & open], with a text and an error that outlive the call.
        unsafe { set(raw, scene, within, error) }
    })
}

fn scenes(subject: &Subject) -> Result<Vec<String>, Ending> {
    match subject.said()?.facts() {
        Facts::Lighting(facts) => Ok(facts.scenes.clone()),
        _ => Err(Ending::Broken("it says it is no lighting".to_owned())),
    }
}

fn sets_each(subject: &Subject) -> Result<(), Ending> {
    let lamp = subject.open()?;
    for _ in 0..2 {
        for scene in scenes(subject)? {
            set(&lamp, abi::Text::from(&scene), timeout(PATIENT))?;
        }
    }
    Ok(())
}

fn refuses_others(subject: &Subject) -> Result<(), Ending> {
    let lamp = subject.open()?;
    let rubbish = Draw::new(subject.probe.seed).bytes(40);
    let rubbish = abi::Text {
        data: rubbish.as_ptr().cast(),
        length: rubbish.len(),
    };
    let first = scenes(subject)?.first().cloned().unwrap_or_default();
    let longer = format!("{first}x");
    let shorter = &first[..first.len().saturating_sub(1)];
    for scene in [
        abi::Text::from("no such scene"),
        abi::Text::from(&longer),
        abi::Text::EMPTY,
        rubbish,
    ] {
        let answer = set(&lamp, scene, timeout(PATIENT));
        expect_failure(
            "a scene that it does not have",
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    if !scenes(subject)?.iter().any(|scene| scene == shorter) {
        let answer = set(&lamp, abi::Text::from(shorter), timeout(PATIENT));
        expect_failure(
            "the beginning of a scene",
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    set(&lamp, abi::Text::from(&first), timeout(PATIENT))?;
    Ok(())
}

fn passed_deadline(subject: &Subject) -> Result<(), Ending> {
    let lamp = subject.open()?;
    for scene in scenes(subject)? {
        let (answer, took) = timed(|| set(&lamp, abi::Text::from(&scene), 0));
        ensure(took < SOON, || {
            format!("no time was given, and it took {took:?}")
        })?;
        match answer {
            Err(error) if error.kind() != ErrorKind::Timeout => return Err(error.into()),
            _ => {}
        }
    }
    Ok(())
}
