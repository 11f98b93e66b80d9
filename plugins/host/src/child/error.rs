//! Errors between a host and its child.

use std::fmt;

use taceva_core::{Access, DriverError, DriverKey, ErrorKind, Found};

use super::exit_status::Fate;
use super::plain::plain;
use super::wire::Failure;

/// Maximum length of a plugin's message, characters. Longer messages are truncated.
const MESSAGE_MAX: usize = 2000;

/// Failure of a child to start or to answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChildError {
    /// The child could not be started.
    Start {
        /// Name of the plugin.
        plugin: String,
        /// Cause.
        why: String,
    },
    /// The child started but refused to serve: it could not confine itself or load its plugin.
    Refused {
        /// Name of the plugin.
        plugin: String,
        /// Kind of the failure.
        kind: ErrorKind,
        /// Cause, as the child reported it.
        why: String,
    },
    /// The library has crashed before, and the user has not released it since.
    Quarantined {
        /// Name of the plugin.
        plugin: String,
        /// Description of the crash.
        reason: String,
    },
    /// The child has ended.
    Gone {
        /// Name of the plugin.
        plugin: String,
        /// Reason for the end of the child.
        fate: Fate,
        /// Last output of the child, with control characters escaped; empty if it printed nothing.
        printed: String,
    },
    /// The request does not fit into a message.
    Unsendable {
        /// Cause.
        why: String,
    },
}

impl ChildError {
    /// Kind of the failure.
    pub fn kind(&self) -> ErrorKind {
        match self {
            ChildError::Start { .. } => ErrorKind::Internal,
            ChildError::Refused { kind, .. } => *kind,
            ChildError::Quarantined { .. } => ErrorKind::PermissionDenied,
            ChildError::Gone { .. } => ErrorKind::Disconnected,
            ChildError::Unsendable { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// Converts the failure into an error of `driver` that names the failed operation `doing`.
    pub fn of(self, driver: &DriverKey, doing: &str) -> DriverError {
        DriverError::new(self.kind(), driver, doing.to_owned()).because(self)
    }
}

impl fmt::Display for ChildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ChildError::Start { plugin, why } => {
                write!(
                    f,
                    "the process of the plugin `{plugin}` did not start: {why}"
                )
            }
            ChildError::Refused { plugin, why, .. } => write!(f, "the plugin `{plugin}`: {why}"),
            ChildError::Quarantined { plugin, reason } => write!(
                f,
                "the plugin `{plugin}` is in quarantine: {reason}; `taceva plugin release {plugin}` lets it start again"
            ),
            ChildError::Gone {
                plugin,
                fate,
                printed,
            } => {
                write!(f, "the plugin `{plugin}` is gone: {fate}")?;
                if matches!(fate, Fate::Late { .. }) {
                    f.write_str("; if that call waits for its device, let it return in time")?;
                }
                match printed.trim() {
                    "" => Ok(()),
                    printed => write!(f, "; it printed last: {}", last_lines(printed)),
                }
            }
            ChildError::Unsendable { why } => f.write_str(why),
        }
    }
}

impl std::error::Error for ChildError {}

/// Last three lines of `printed`, at most 400 characters.
fn last_lines(printed: &str) -> String {
    let lines: Vec<&str> = printed.lines().rev().take(3).collect();
    let lines: Vec<&str> = lines.into_iter().rev().collect();
    let text = lines.join(" / ");
    let surplus = text.chars().count().saturating_sub(400);
    text.chars().skip(surplus).collect()
}

impl Failure {
    /// Converts a driver's error into a failure that the child sends to the host.
    pub(crate) fn of(error: &DriverError) -> Failure {
        Failure {
            kind: error.kind(),
            doing: cut(error.doing()),
            cause: std::error::Error::source(error).map(|cause| cut(&cause.to_string())),
            fault: error.fault(),
        }
    }

    /// Creates a failure of the child itself.
    pub(crate) fn new(kind: ErrorKind, doing: &str, why: &str) -> Failure {
        Failure {
            kind,
            doing: doing.to_owned(),
            cause: Some(cut(why)),
            fault: None,
        }
    }

    /// Rebuilds the error of `driver` with the text that it would have without a child process. Control characters are escaped.
    pub(crate) fn to_error(&self, driver: &DriverKey) -> DriverError {
        let mut error = DriverError::new(self.kind, driver, plain(&cut(&self.doing)));
        if let Some(fault) = self.fault {
            error = error.with_fault(fault);
        }
        match &self.cause {
            Some(cause) => error.because(plain(&cut(cause))),
            None => error,
        }
    }
}

/// Escapes control characters in the plugin's description of a found device.
pub(crate) fn plain_found(found: Found) -> Found {
    Found::new(found.driver, plain(&cut(&found.title)))
        .with_arguments(plain(&cut(&found.arguments)))
        .with_access(match found.access {
            Access::Denied { remedy } => Access::Denied {
                remedy: plain(&cut(&remedy)),
            },
            access => access,
        })
}

fn cut(text: &str) -> String {
    match text.char_indices().nth(MESSAGE_MAX) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRIVER: DriverKey = DriverKey::fixed("org.example.x/camera");

    #[test]
    fn an_error_says_the_same_on_both_sides_of_the_boundary() {
        let bare = DriverError::new(ErrorKind::Timeout, &DRIVER, "capture a frame");
        assert_eq!(
            Failure::of(&bare).to_error(&DRIVER).to_string(),
            bare.to_string()
        );
        let caused = bare.because("no frame within 40ms");
        let copy = Failure::of(&caused).to_error(&DRIVER);
        assert_eq!(copy.to_string(), caused.to_string());
        assert_eq!(copy.kind(), ErrorKind::Timeout);
        for fault in taceva_core::Fault::ALL {
            let stopped = DriverError::new(ErrorKind::DeviceFault, &DRIVER, "move");
            let stopped = stopped.with_fault(fault);
            let copy = Failure::of(&stopped).to_error(&DRIVER);
            assert_eq!(
                (copy.fault(), copy.to_string()),
                (Some(fault), stopped.to_string())
            );
        }
    }

    #[test]
    fn a_message_of_a_plugin_is_short_and_harms_no_terminal() {
        let failure = Failure::new(
            ErrorKind::DeviceFault,
            "read",
            &format!("\u{1b}]52;c;\u{7}{}", "x".repeat(10_000)),
        );
        let text = failure.to_error(&DRIVER).to_string();
        assert!(text.contains("\\u{1b}]52"), "{text}");
        assert!(text.chars().count() < 2200);
    }

    #[test]
    fn a_child_that_is_gone_says_how_and_what_it_printed_last() {
        let gone = ChildError::Gone {
            plugin: "org.example.x".to_owned(),
            fate: Fate::Exited { code: 0 },
            printed: "one\ntwo\nthree\nfour\n".to_owned(),
        };
        assert_eq!(
            gone.of(&DRIVER, "capture a frame").to_string(),
            "org.example.x/camera: cannot capture a frame: the plugin `org.example.x` is gone: its process exited by itself with code 0; it printed last: two / three / four"
        );
    }
}
