//! One attempt at a check, in a child with a time limit.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use taceva_core::ErrorKind;
use taceva_host::bare::CALL;
use taceva_host::{
    ChildError, Examination, ExaminationError, ExaminationOrder, Fate, Log, NOT_ALLOWED,
};

use super::probe::Probe;
use super::{library, run};
use crate::report::Outcome;
use crate::trial::NO_DEVICE;

/// Text in the message of a check whose device failed to open.
const NOT_OPENED: &str = ": cannot open the device: ";

/// Outcome of one attempt to run a check.
#[derive(Debug)]
pub(super) struct Attempt {
    pub(super) outcome: Outcome,
    /// Plugin call that exceeded the time limit, after which the child was killed; `None` if no call did.
    pub(super) hung_in: Option<String>,
    /// Time for which this call was pending.
    pub(super) hung_for: Duration,
}

/// Pending call of a child, and the time at which the child named it.
struct Pending {
    call: String,
    since: Instant,
}

impl From<Outcome> for Attempt {
    fn from(outcome: Outcome) -> Attempt {
        Attempt {
            outcome,
            hung_in: None,
            hung_for: Duration::ZERO,
        }
    }
}

/// Runs the checks of `probe` in a child process, which is killed after `limit`.
pub(super) fn attempt(examination: &Examination<'_>, probe: &Probe, limit: Duration) -> Attempt {
    let pending = Arc::new(Mutex::new(Pending {
        call: String::new(),
        since: Instant::now(),
    }));
    let order = ExaminationOrder {
        driver: &probe.driver,
        arguments: &probe.arguments,
        limit,
        log: noting(&pending),
    };
    let printed = examination.run(order, |arguments| {
        let probe = Probe {
            arguments,
            ..probe.clone()
        };
        serde_json::to_vec(&probe).expect("texts and numbers")
    });
    let (error, withheld, lacks_bound) = match printed {
        Ok(printed) if probe.check == library::QUIET && !printed.is_empty() => {
            return Outcome::Failed(format!("it printed {printed:?}")).into();
        }
        Ok(_) => return Outcome::Passed.into(),
        Err(ExaminationError::Unready(why)) => return Outcome::Failed(why).into(),
        Err(ExaminationError::Child {
            error,
            withheld,
            lacks_bound,
        }) => (error, withheld, lacks_bound),
    };
    let pending = pending.lock().unwrap_or_else(PoisonError::into_inner);
    let hung_for = pending.since.elapsed();
    let error = with_call(*error, &pending.call);
    let hung_in = call_of(&error);
    let outcome = ended(error);
    // A plugin may report a withheld resource as missing, which would not count as a failure.
    let outcome = match &outcome {
        // The plugin's arguments name a resource without permission, so host names were not resolved either. This is one cause, for any report of
        // the plugin.
        Outcome::Failed(why) | Outcome::Skipped(why)
            if lacks_bound && (why.starts_with(NO_DEVICE) || why.contains(NOT_OPENED)) =>
        {
            Outcome::Failed(format!("{NOT_ALLOWED}; {withheld}"))
        }
        Outcome::Failed(why) | Outcome::Skipped(why) => {
            let explained = withheld.explain(why);
            explained.map_or(outcome, Outcome::Failed)
        }
        Outcome::Passed => outcome,
    };
    Attempt {
        outcome,
        hung_in,
        hung_for,
    }
}

/// Creates a log that stores the pending plugin call in `pending`.
fn noting(pending: &Arc<Mutex<Pending>>) -> Log {
    let pending = Arc::clone(pending);
    Box::new(move |_, target, message| {
        if target == CALL {
            *pending.lock().unwrap_or_else(PoisonError::into_inner) = Pending {
                call: message.to_owned(),
                since: Instant::now(),
            };
        }
    })
}

/// Plugin call that exceeded the time limit, taken from the error of the killed child; `None` for other errors.
fn call_of(error: &ChildError) -> Option<String> {
    match error {
        ChildError::Gone {
            fate: Fate::Late { doing, .. },
            ..
        } => Some(doing.clone()),
        _ => None,
    }
}

/// Adds the name of the hanging call to the error of a killed child. Leaves the error unchanged if the name is unknown.
fn with_call(error: ChildError, call: &str) -> ChildError {
    match error {
        ChildError::Gone {
            plugin,
            fate: Fate::Late { after, .. },
            printed,
        } if !call.is_empty() => ChildError::Gone {
            plugin,
            fate: Fate::Late {
                doing: call.to_owned(),
                after,
            },
            printed,
        },
        other => other,
    }
}

fn ended(error: ChildError) -> Outcome {
    match error {
        ChildError::Refused {
            kind: ErrorKind::Unsupported,
            why,
            ..
        } if why.starts_with(run::SKIPPED) => {
            Outcome::Skipped(why[run::SKIPPED.len()..].to_owned())
        }
        ChildError::Refused { why, .. } => Outcome::Failed(why),
        ChildError::Gone { fate, printed, .. } if printed.is_empty() => {
            Outcome::Failed(format!("the process ended: {fate}"))
        }
        ChildError::Gone { fate, printed, .. } => {
            Outcome::Failed(format!("the process ended: {fate}; it printed {printed:?}"))
        }
        other => Outcome::Failed(other.to_string()),
    }
}
