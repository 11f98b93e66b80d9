//! The suite for changers.

use taceva_core::{Changer, Deadline, ErrorKind, Factory, Facts};

use super::bench::{Bench, Test, Unmet, answered, broken, expect, refused, run};
use super::{Report, Trial};

/// Tries a changer, which moves.
pub fn changer(factory: &dyn Factory<dyn Changer>, trial: &Trial) -> Report {
    run(factory, trial, TESTS)
}

const TESTS: &[Test<dyn Changer>] = &[
    ("holds what it declares", |bench| {
        let declared = declared(bench)?;
        let changer = bench.open()?;
        expect(changer.holds() == declared, || {
            format!("holds {:?}, declares {declared:?}", changer.holds())
        })
    }),
    ("brings each thing that it holds, and says so", |bench| {
        let (mut changer, holds) = holding(bench)?;
        for name in holds.iter().chain(&holds) {
            let there = changer.bring(name, bench.trial.deadline)?;
            expect(there == *name, || {
                format!("asked for `{name}`, says that `{there}` is in place")
            })?;
        }
        Ok(())
    }),
    ("refuses what it does not hold", |bench| {
        let (mut changer, holds) = holding(bench)?;
        for stranger in ["", &format!("{}x", holds[0])] {
            let brought = changer.bring(stranger, bench.trial.deadline);
            let kinds = [ErrorKind::InvalidArgument];
            refused("bringing what it does not hold", brought, &kinds)?;
        }
        Ok(())
    }),
    ("answers a deadline that has passed at once", |bench| {
        let (mut changer, holds) = holding(bench)?;
        let last = &holds[holds.len() - 1];
        let brought = bench.at_once("bringing", || changer.bring(last, Deadline::PASSED))?;
        answered("bringing without time", brought, ErrorKind::Timeout)?;
        changer.bring(&holds[0], bench.trial.deadline)?;
        Ok(())
    }),
];

fn declared<'a>(bench: &'a Bench<'_, dyn Changer>) -> Result<&'a [String], Unmet> {
    match bench.descriptor.facts() {
        Facts::Changer(facts) => Ok(&facts.holds),
        other => Err(broken(format!("declares a {}", other.kind()))),
    }
}

fn holding(bench: &Bench<'_, dyn Changer>) -> Result<(Box<dyn Changer>, Vec<String>), Unmet> {
    match declared(bench)?.to_vec() {
        holds if holds.is_empty() => Err(Unmet::Inapplicable(
            "with these arguments it holds nothing".to_owned(),
        )),
        holds => Ok((bench.open()?, holds)),
    }
}
