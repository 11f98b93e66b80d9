//! How a child ended, in words.

use std::fmt;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;
use std::time::Duration;

/// What a device is asked for last; nobody waits for it any more.
pub(super) const CLOSING: &str = "close the device";
/// What a child is asked for last.
pub(super) const ENDING: &str = "end";

/// How a child ended.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fate {
    /// Its last device was closed, and it was asked to end.
    Closed,
    /// It called `exit`, which no plugin may.
    Exited {
        /// With this code.
        code: i32,
    },
    /// A signal ended it.
    Signalled {
        /// This one.
        signal: i32,
    },
    /// It was ended because it did not answer.
    Late {
        /// What it was asked to do, in words that follow "cannot".
        doing: String,
        /// How long it had.
        after: Duration,
    },
    /// It was ended because it did not follow the rules.
    Breach {
        /// What it did.
        what: String,
    },
}

impl Fate {
    /// What the status of a process that ended says.
    pub(crate) fn of(status: ExitStatus) -> Fate {
        match (status.signal(), status.code()) {
            (Some(signal), _) => Fate::Signalled { signal },
            (None, code) => Fate::Exited {
                code: code.unwrap_or(-1),
            },
        }
    }

    /// Whether it ended while nobody waited for an answer, so that no error tells of it.
    pub(crate) fn is_unheard(&self) -> bool {
        matches!(self, Fate::Late { doing, .. } if doing == CLOSING || doing == ENDING)
    }

    /// Whether the plugin is to blame: whatever it did by itself, not what somebody else did to it.
    pub fn is_its_own_fault(&self) -> bool {
        match self {
            Fate::Closed => false,
            Fate::Exited { .. } | Fate::Late { .. } | Fate::Breach { .. } => true,
            Fate::Signalled { signal } => ![
                libc::SIGKILL,
                libc::SIGTERM,
                libc::SIGINT,
                libc::SIGHUP,
                libc::SIGQUIT,
            ]
            .contains(signal),
        }
    }
}

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fate::Closed => f.write_str("its process was closed"),
            Fate::Exited { code } => write!(f, "its process exited by itself with code {code}"),
            Fate::Signalled { signal } => {
                write!(f, "its process was ended by signal {signal}")?;
                match meaning(*signal) {
                    Some(meaning) => write!(f, ", {meaning}"),
                    None => Ok(()),
                }
            }
            Fate::Late { doing, after } => write!(
                f,
                "its process was ended because it did not {doing} within {after:?}"
            ),
            Fate::Breach { what } => {
                write!(
                    f,
                    "its process was ended because it broke the rules: {what}"
                )
            }
        }
    }
}

fn meaning(signal: i32) -> Option<&'static str> {
    Some(match signal {
        libc::SIGSEGV => "an access to memory that is not there",
        libc::SIGBUS => "an access to memory that cannot be read",
        libc::SIGILL => "an instruction that does not exist",
        libc::SIGFPE => "an impossible division",
        libc::SIGABRT => "it gave itself up",
        libc::SIGSYS => "a system call that is not allowed",
        libc::SIGTRAP => "a breakpoint",
        libc::SIGXFSZ => "a file larger than allowed",
        libc::SIGXCPU => "more computing time than allowed",
        libc::SIGKILL => "ended from outside",
        libc::SIGTERM => "asked to end from outside",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_tells_in_words_what_happened_and_whose_fault_it_was() {
        let crash = Fate::of(ExitStatus::from_raw(libc::SIGSEGV));
        assert_eq!(
            crash.to_string(),
            "its process was ended by signal 11, an access to memory that is not there"
        );
        assert!(crash.is_its_own_fault());
        let exit = Fate::of(ExitStatus::from_raw(3 << 8));
        assert_eq!(exit, Fate::Exited { code: 3 });
        assert!(exit.is_its_own_fault());
        assert!(!Fate::of(ExitStatus::from_raw(libc::SIGKILL)).is_its_own_fault());
        assert!(!Fate::Closed.is_its_own_fault());
    }
}
