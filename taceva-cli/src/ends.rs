//! What must be so before any work: results can be written somewhere, and a file that may not grow is an error and not the end.

/// Whether standard output was closed when the program began (`>&-`): Rust opens `/dev/null` in its place before `main`, where every result
/// would be lost without a word.
#[cfg(unix)]
pub(crate) fn standard_output_is_closed() -> bool {
    before_main::WAS_CLOSED.load(std::sync::atomic::Ordering::Relaxed)
}

/// Elsewhere a write to a closed standard output fails as any other.
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
        /// One system call and one store: nothing of what `main` sets up is there yet.
        #[ctor(unsafe)]
        fn look() {
            let is_closed = fcntl_getfd(stdout()) == Err(Errno::BADF);
            WAS_CLOSED.store(is_closed, Ordering::Relaxed);
        }
    }
}

/// A write beyond the limit of a file's size (`ulimit -f`) fails from now on, instead of ending the program where it stands: the error
/// is told, and what was begun is removed.
#[cfg(unix)]
pub(crate) fn refuse_to_end_at_the_limit_of_file_sizes() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use signal_hook::{consts::SIGXFSZ, flag};

    // Whoever writes hears of it; without a handler the signal ends the program as it always did.
    drop(flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false))));
}

/// Other systems know no such signal.
#[cfg(not(unix))]
pub(crate) fn refuse_to_end_at_the_limit_of_file_sizes() {}
