//! Checks before any work: a closed standard output, and the limit of file sizes.

/// True if standard output was closed when the program started (`>&-`). Rust replaces a closed output by `/dev/null` before `main`, so that results
/// would be lost without a message.
#[cfg(unix)]
pub(crate) fn standard_output_is_closed() -> bool {
    before_main::WAS_CLOSED.load(std::sync::atomic::Ordering::Relaxed)
}

/// Returns false: outside Unix, a closed standard output is reported as a write error.
#[cfg(not(unix))]
pub(crate) fn standard_output_is_closed() -> bool {
    false
}

#[cfg(unix)]
mod before_main {
    use std::sync::atomic::{AtomicBool, Ordering};

    use rustix::io::{Errno, fcntl_getfd};
    use rustix::stdio::stdout;

    pub(super) static WAS_CLOSED: AtomicBool = AtomicBool::new(false);

    ctor::declarative::ctor! {
        /// Checks standard output. Makes only one system call and one store, because the Rust runtime is not yet initialised.
        #[ctor(unsafe)]
        fn look() {
            let is_closed = fcntl_getfd(stdout()) == Err(Errno::BADF);
            WAS_CLOSED.store(is_closed, Ordering::Relaxed);
        }
    }
}

/// Makes a write beyond the limit of file sizes (`ulimit -f`) fail instead of ending the program: the error is then reported, and the
/// incomplete file removed.
#[cfg(unix)]
pub(crate) fn refuse_to_end_at_the_limit_of_file_sizes() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use signal_hook::{consts::SIGXFSZ, flag};

    // The write returns the error. If the handler cannot be set, the signal ends the program as by default.
    drop(flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false))));
}

/// Does nothing: outside Unix, no signal reports the limit of file sizes.
#[cfg(not(unix))]
pub(crate) fn refuse_to_end_at_the_limit_of_file_sizes() {}
