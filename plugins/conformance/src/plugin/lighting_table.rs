//! Checks of lighting devices.

#![expect(
    unsafe_code,
    reason = "the test calls functions of the device with arguments that no host passes"
)]

use taceva_abi as abi;
use taceva_core::{DriverKind, ErrorKind, Facts};

use super::subject::{Draw, PATIENT, Subject};
use super::{Check, Of};
use crate::promise::{Unmet, broken, refused};
use taceva_host::bare::timeout;

const OF: Of = Of::Kind(DriverKind::Lighting);

pub(super) const CHECKS: &[Check] = &[OF.check("lighting/refuses-other-scenes", refuses_others)];

type Lamp = taceva_host::bare::Opened<abi::LightingCalls>;

fn set(lamp: &Lamp, scene: abi::Text, within: u64) -> Result<(), taceva_core::DriverError> {
    let set = lamp.handle.needs(lamp.calls.set, "set")?;
    lamp.handle.call("set the light", |raw, error| {
        // SAFETY: [owner & open], with a text and an error that outlive the call.
        unsafe { set(raw, scene, within, error) }
    })
}

fn scenes(subject: &Subject) -> Result<Vec<String>, Unmet> {
    match subject.said()?.facts() {
        Facts::Lighting(facts) => Ok(facts.scenes.clone()),
        _ => Err(broken("it does not describe itself as a lighting")),
    }
}

fn refuses_others(subject: &Subject) -> Result<(), Unmet> {
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
        refused(
            "setting an unknown scene",
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    if !scenes(subject)?.iter().any(|scene| scene == shorter) {
        let answer = set(&lamp, abi::Text::from(shorter), timeout(PATIENT));
        refused(
            "setting the beginning of the name of a scene",
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    set(&lamp, abi::Text::from(&first), timeout(PATIENT))?;
    Ok(())
}
