//! Verification of a bundle for programs that embed the command.

use std::ffi::OsString;
use std::num::NonZeroUsize;

use anyhow::anyhow;
use taceva_bundle::{Outcome, Verification};
use taceva_core::SilentProgress;

use crate::args::{BundleSubject, Cli, Command, ListFormat};
use crate::{cmd, report};

/// Outcome of `taceva bundle verify`, in the forms that the command writes.
///
/// ```
/// let words = ["taceva", "bundle", "verify", "nowhere.tar.gz"];
/// let refused = taceva_cli::verify_bundle(words).expect_err("no such file");
/// assert!(taceva_cli::one_line(&refused).contains("nowhere.tar.gz"));
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BundleVerification {
    /// Text for readers.
    pub text: String,
    /// JSON `taceva.verification/1`.
    pub document: String,
    /// True if the command would end with the exit code 0.
    pub is_verified: bool,
}

/// Verifies the bundle of `arguments`, which begin with the name of the program. Writes nothing and handles no signal.
///
/// # Errors
/// Errors of the command, and an error for arguments of another command. [`one_line`](crate::one_line) formats them. A damaged bundle is not an
/// error.
pub fn verify_bundle<W: Into<OsString> + Clone>(
    arguments: impl IntoIterator<Item = W>,
) -> anyhow::Result<BundleVerification> {
    let cli = Cli::parsed_from(arguments)?;
    cmd::check_isa()?;
    let subject = match &cli.command {
        Some(Command::Bundle(bundle)) => bundle.subject.as_ref(),
        _ => None,
    };
    let Some(BundleSubject::Verify(args)) = subject else {
        return Err(anyhow!("expected the command `bundle verify`"));
    };
    // One thread, because the caller decides on the number of threads.
    let found = cmd::bundle::verification(args, NonZeroUsize::MIN, &SilentProgress)?;
    Ok(BundleVerification {
        text: rendered(&found, ListFormat::Text)?,
        document: rendered(&found, ListFormat::Json)?,
        is_verified: found.outcome() == Outcome::Verified,
    })
}

fn rendered(found: &Verification, format: ListFormat) -> anyhow::Result<String> {
    let mut bytes = Vec::new();
    report::bundle::verification(found, format, &mut bytes)?;
    Ok(String::from_utf8(bytes)?)
}
