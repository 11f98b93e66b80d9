//! Child process of this program that only decodes AV1, without other rights.

use std::ffi::OsString;
use std::sync::atomic::{AtomicBool, Ordering};

/// Argument that starts this program as the child process.
const WORD: &str = "decode-av1-for-its-parent";

/// True if the `main` of this program calls `main_if_child`.
static CAN_BE_CHILD: AtomicBool = AtomicBool::new(false);

/// Decodes for the parent and exits, if this is the child process.
#[cfg(feature = "av1")]
pub(crate) fn main_if_child() {
    CAN_BE_CHILD.store(true, Ordering::Relaxed);
    let mut arguments = std::env::args_os().skip(1);
    if arguments.next().is_none_or(|word| word != WORD) || arguments.next().is_some() {
        return;
    }
    let served = taceva_video::av1::serve(std::io::stdin().lock(), std::io::stdout().lock());
    if let Err(error) = &served {
        // The parent forwards it.
        crate::stderr::write(&format!("{error}\n"));
    }
    std::process::exit(i32::from(served.is_err()));
}

/// Command line that starts the child process; `None` without the feature, or without [`main_if_child`](crate::main_if_child) in `main`.
pub(crate) fn command() -> Option<Vec<OsString>> {
    if !CAN_BE_CHILD.load(Ordering::Relaxed) {
        return None;
    }
    let program = std::env::current_exe().ok()?;
    Some(vec![program.into_os_string(), WORD.into()])
}
