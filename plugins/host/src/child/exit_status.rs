//! Reason for the end of a child process, and its description.

use std::fmt;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;
use std::time::Duration;

/// Operation name of the close call of a device. No caller waits for the result.
pub(super) const CLOSING: &str = "close the device";
/// Operation name of the last order to a child.
pub(super) const ENDING: &str = "end";

/// Reason for the end of a child process.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fate {
    /// The child ended on request, after its last device was closed.
    Closed,
    /// The child called `exit`, which is forbidden to plugins.
    Exited {
        /// Exit code; -1 if the system reports none.
        code: i32,
    },
    /// A signal killed the child.
    Signalled {
        /// Signal number.
        signal: i32,
    },
    /// The host killed the child because it did not answer in time.
    Late {
        /// The operation, in words that follow "cannot".
        doing: String,
        /// Timeout of the call.
        after: Duration,
    },
    /// The host killed the child because it broke a rule.
    Breach {
        /// Description of the breach.
        what: String,
    },
}

impl Fate {
    /// Converts the exit status of a process.
    pub(crate) fn of(status: ExitStatus) -> Fate {
        match (status.signal(), status.code()) {
            (Some(signal), _) => Fate::Signalled { signal },
            (None, code) => Fate::Exited {
                code: code.unwrap_or(-1),
            },
        }
    }

    /// True if closing a device or ending the child timed out. No caller receives an error for these operations.
    pub(crate) fn is_unheard(&self) -> bool {
        matches!(self, Fate::Late { doing, .. } if doing == CLOSING || doing == ENDING)
    }

    /// True if the plugin is to blame. False after a requested end, and after signals from other processes, such as SIGKILL or SIGTERM.
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
                    "its process was ended because it violated the protocol: {what}"
                )
            }
        }
    }
}

fn meaning(signal: i32) -> Option<&'static str> {
    Some(match signal {
        libc::SIGSEGV => "an access to unmapped memory",
        libc::SIGBUS => "an invalid access to memory",
        libc::SIGILL => "an illegal instruction",
        libc::SIGFPE => "an arithmetic error",
        libc::SIGABRT => "it aborted",
        libc::SIGSYS => "a forbidden system call",
        libc::SIGTRAP => "a breakpoint",
        libc::SIGXFSZ => "a file larger than allowed",
        libc::SIGXCPU => "more processor time than allowed",
        libc::SIGKILL => "killed from outside",
        libc::SIGTERM => "terminated from outside",
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
            "its process was ended by signal 11, an access to unmapped memory"
        );
        assert!(crash.is_its_own_fault());
        let exit = Fate::of(ExitStatus::from_raw(3 << 8));
        assert_eq!(exit, Fate::Exited { code: 3 });
        assert!(exit.is_its_own_fault());
        assert!(!Fate::of(ExitStatus::from_raw(libc::SIGKILL)).is_its_own_fault());
        assert!(!Fate::Closed.is_its_own_fault());
    }
}
