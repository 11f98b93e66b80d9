//! Promises of the function table of a changer, tested with item names that a host would never pass.

#![expect(
    unsafe_code,
    reason = "the test calls functions of the device with arguments that no host passes"
)]

use taceva_abi as abi;
use taceva_core::{DriverError, DriverKind, ErrorKind};

use super::subject::{Draw, PATIENT, Subject};
use super::{Check, Of};
use crate::promise::{Unmet, refused, skipped};
use taceva_host::Session;
use taceva_host::bare::{Taken, take, timeout};

const OF: Of = Of::Kind(DriverKind::Changer);

pub(super) const CHECKS: &[Check] = &[
    OF.check("changer/refuses-other-names", refuses_others),
    OF.check("changer/nobody-takes-the-name", nobody_takes),
];

/// Names of the changer's items. Skips the promise if the changer has no items.
fn holds(subject: &Subject) -> Result<Vec<String>, Unmet> {
    let session = &subject.session;
    let changer = subject.opened(session.changer(subject.key()?, &subject.args()?))?;
    match changer.holds().to_vec() {
        holds if holds.is_empty() => Err(skipped("with these arguments, the changer has no items")),
        holds => Ok(holds),
    }
}

type Bare = taceva_host::bare::Opened<abi::ChangerCalls>;

/// Calls the plugin's function `bring` directly, because the host would reject unknown names before the call.
fn bare_bring(changer: &Bare, name: abi::Text, take: abi::TakeText) -> Result<(), DriverError> {
    let bring = changer.handle.needs(changer.calls.bring, "bring")?;
    let mut taken = Taken::default();
    let context = taken.context();
    changer.handle.call("bring it into place", |raw, error| {
        // SAFETY: [owner & open], with a text, a context and an error that outlive the call.
        unsafe { bring(raw, name, timeout(PATIENT), take, context, error) }
    })
}

fn refuses_others(subject: &Subject) -> Result<(), Unmet> {
    let holds = holds(subject)?;
    let changer: Bare = subject.open()?;
    let rubbish = Draw::new(subject.probe.seed).bytes(40);
    let rubbish = abi::Text {
        data: rubbish.as_ptr().cast(),
        length: rubbish.len(),
    };
    let longer = format!("{}x", holds[0]);
    for name in [
        abi::Text::from("no such thing"),
        abi::Text::from(&longer),
        abi::Text::EMPTY,
        rubbish,
    ] {
        let answer = bare_bring(&changer, name, Some(take));
        let kinds = [ErrorKind::InvalidArgument];
        refused("bringing an unknown name", answer, &kinds)?;
    }
    Ok(())
}

fn nobody_takes(subject: &Subject) -> Result<(), Unmet> {
    subject.may_move()?;
    let holds = holds(subject)?;
    let changer: Bare = subject.open()?;
    let answer = bare_bring(&changer, abi::Text::from(&holds[0]), None);
    let kinds = [ErrorKind::InvalidArgument];
    refused(
        "calling `bring` without a callback for the name",
        answer,
        &kinds,
    )
}
