//! Promises of changers: behaviour that every changer must show in a test.

use std::time::Instant;

use taceva_core::{Changer, Deadline, ErrorKind, Factory, Facts};

use crate::promise::{Unmet, answered, broken, expect, refused, skipped};
use crate::report::Report;
use crate::trial::{Alarm, Promise, Trial, Tried, report, was_within};

/// Tests a changer. The test moves each item of the changer into place, if `trial` allows motions.
pub fn changer(factory: &dyn Factory<dyn Changer>, trial: &Trial) -> Report {
    report(factory, trial, PROMISES)
}

pub(crate) const PROMISES: &[Promise<dyn Changer>] = &[
    ("changer/holds-what-it-says", |tried| {
        let declared = declared(tried)?;
        let changer = tried.open()?;
        expect(changer.holds() == declared, || {
            format!(
                "it has the items {:?}, but declares {declared:?}",
                changer.holds()
            )
        })
    }),
    ("changer/brings-each-thing", brings_each),
    ("changer/refuses-other-names", refuses_others),
    ("changer/passed-deadline", passed_deadline),
    ("changer/interrupt-within-50-ms", interrupt),
];

type Subject<'a> = Tried<'a, dyn Changer>;

fn declared<'a>(tried: &'a Subject<'_>) -> Result<&'a [String], Unmet> {
    match tried.descriptor.facts() {
        Facts::Changer(facts) => Ok(&facts.holds),
        other => Err(broken(format!("declares itself a {}", other.kind()))),
    }
}

/// Opens the changer and lists its items. Skips the promise if the changer has no items.
fn holding(tried: &Subject<'_>) -> Result<(Box<dyn Changer>, Vec<String>), Unmet> {
    let changer = tried.open()?;
    match changer.holds().to_vec() {
        holds if holds.is_empty() => Err(skipped("with these arguments, the changer has no items")),
        holds => Ok((changer, holds)),
    }
}

/// Brings all items twice, so that each item follows another item and itself.
fn brings_each(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let (mut changer, holds) = holding(tried)?;
    for name in holds.iter().chain(&holds).flat_map(|name| [name, name]) {
        let there = changer.bring(name, tried.trial.deadline)?;
        expect(there == *name, || {
            format!("asked to bring `{name}`, it reports `{there}` in place")
        })?;
    }
    Ok(())
}

fn refuses_others(tried: &Subject<'_>) -> Result<(), Unmet> {
    let (mut changer, holds) = holding(tried)?;
    for stranger in ["", &format!("{}x", holds[0])] {
        let brought = changer.bring(stranger, tried.trial.deadline);
        let kinds = [ErrorKind::InvalidArgument];
        refused("bringing an unknown name", brought, &kinds)?;
    }
    Ok(())
}

fn passed_deadline(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let (mut changer, holds) = holding(tried)?;
    for name in holds.iter().rev() {
        let doing = "bringing without time";
        let brought = tried.at_once(doing, || changer.bring(name, Deadline::PASSED))?;
        answered(doing, brought, ErrorKind::Timeout)?;
    }
    // The changer still works afterwards.
    changer.bring(&holds[0], tried.trial.deadline)?;
    Ok(())
}

fn interrupt(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let (mut changer, holds) = holding(tried)?;
    let interrupt = changer.interrupt_handle();
    changer.bring(&holds[0], tried.trial.deadline)?;
    let alarm = Alarm::set(interrupt)?;
    let brought = changer.bring(&holds[holds.len() - 1], tried.trial.deadline);
    let ended = Instant::now();
    let at = alarm.wait()?;
    if brought.is_err() {
        let kinds = [ErrorKind::Interrupted];
        refused("an interrupted change", brought, &kinds)?;
        let late = ended.saturating_duration_since(at);
        was_within(
            "the change after an interrupt",
            late,
            tried.trial.acts_within,
        )?;
    }
    // An interrupt ends only one call.
    changer.bring(&holds[0], tried.trial.deadline)?;
    Ok(())
}
