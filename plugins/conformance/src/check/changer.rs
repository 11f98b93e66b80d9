//! Checks of changers. Those that move one are made on simulations alone, unless the user allows it.

#![expect(
    unsafe_code,
    reason = "the functions of the device are called as no host does"
)]

use std::thread;
use std::time::Duration;

use taceva_abi as abi;
use taceva_core::{Changer, Deadline, DriverError, DriverKind, ErrorKind};

use super::subject::{
    AT_ONCE, Draw, Ending, PATIENT, SOON, Subject, ensure, expect_failure, timed,
};
use super::{Check, Of};
use taceva_host::Session;
use taceva_host::bare::{Taken, take, timeout};

pub(super) const CHECKS: &[Check] = &[
    check("changer/brings-each-thing", brings_each),
    check("changer/refuses-other-names", refuses_others),
    check("changer/passed-deadline", passed_deadline),
    check("changer/interrupt-within-50-ms", interrupt),
    check("changer/nobody-takes-the-name", nobody_takes),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Changer),
        run,
    }
}

fn open(subject: &Subject) -> Result<Box<dyn Changer>, Ending> {
    subject.opened(subject.session.changer(subject.key()?, &subject.args()?))
}

/// The changer and what it holds; skipped where its arguments have it hold nothing.
fn holding(subject: &Subject) -> Result<(Box<dyn Changer>, Vec<String>), Ending> {
    let changer = open(subject)?;
    let holds = changer.holds().to_vec();
    if holds.is_empty() {
        let why = "with these arguments it holds nothing".to_owned();
        return Err(Ending::Skipped(why));
    }
    Ok((changer, holds))
}

/// Round twice, so that each thing comes after another and after itself.
fn brings_each(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let (mut changer, holds) = holding(subject)?;
    for name in holds.iter().chain(&holds) {
        for _ in 0..2 {
            let there = changer.bring(name, PATIENT)?;
            ensure(there == *name, || {
                format!("asked for `{name}`, it says that `{there}` is in place")
            })?;
        }
    }
    Ok(())
}

type Bare = taceva_host::bare::Opened<abi::ChangerCalls>;

/// Past the host, which knows what it holds and refuses the rest.
fn bare_bring(
    changer: &Bare,
    name: abi::Text,
    (within, takes): (u64, bool),
) -> Result<(), DriverError> {
    let bring = changer.handle.needs(changer.calls.bring, "bring")?;
    let mut taken = Taken::default();
    let context = taken.context();
    let take: abi::TakeText = if takes { Some(take) } else { None };
    changer.handle.call("bring it into place", |raw, error| {
        // SAFETY: [owner & open], with a text, a context and an error that outlive the call.
        unsafe { bring(raw, name, within, take, context, error) }
    })
}

fn refuses_others(subject: &Subject) -> Result<(), Ending> {
    let (changer, holds) = holding(subject)?;
    drop(changer);
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
        let answer = bare_bring(&changer, name, (timeout(PATIENT), true));
        let kinds = [ErrorKind::InvalidArgument];
        expect_failure("a name that it does not hold", answer, &kinds)?;
    }
    Ok(())
}

fn passed_deadline(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let (mut changer, holds) = holding(subject)?;
    for name in &holds {
        let (answer, took) = timed(|| changer.bring(name, Deadline::PASSED));
        ensure(took < SOON, || {
            format!("no time was given, and it took {took:?}")
        })?;
        match answer {
            Err(error) if error.kind() != ErrorKind::Timeout => return Err(error.into()),
            _ => {}
        }
    }
    // It is usable after it.
    changer.bring(&holds[0], PATIENT)?;
    Ok(())
}

fn interrupt(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let (mut changer, holds) = holding(subject)?;
    let Some(interrupt) = changer.interrupt_handle() else {
        return Err(Ending::Skipped("it cannot be interrupted".to_owned()));
    };
    changer.bring(&holds[0], PATIENT)?;
    let last = &holds[holds.len() - 1];
    let ringer = thread::spawn(move || {
        thread::sleep(Duration::from_millis(20));
        let now = std::time::Instant::now();
        interrupt.interrupt();
        now
    });
    let answer = changer.bring(last, PATIENT);
    let ended = std::time::Instant::now();
    let at = ringer
        .join()
        .map_err(|_| Ending::Broken("the check panicked".to_owned()))?;
    if answer.is_err() {
        expect_failure(
            "a change that was interrupted",
            answer,
            &[ErrorKind::Interrupted],
        )?;
        let late = ended.saturating_duration_since(at);
        ensure(late < AT_ONCE, || {
            format!("it took {late:?}, expected at most {AT_ONCE:?}")
        })?;
    }
    // An interrupt ends one call, and no other.
    changer.bring(&holds[0], PATIENT)?;
    Ok(())
}

fn nobody_takes(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let (changer, holds) = holding(subject)?;
    drop(changer);
    let changer: Bare = subject.open()?;
    let answer = bare_bring(
        &changer,
        abi::Text::from(&holds[0]),
        (timeout(PATIENT), false),
    );
    let kinds = [ErrorKind::InvalidArgument];
    expect_failure("nobody who takes the name", answer, &kinds)
}
