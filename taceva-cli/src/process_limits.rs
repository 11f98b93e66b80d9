//! Limits of the process that are handled before any work: a closed standard output, and the limit of file sizes.

/// Whether standard output was closed when the program began (`>&-`): Rust opens `/dev/null` in its place before `main`, where every result
/// would be lost without a message.
#[cfg(unix)]
pub(crate) fn standard_output_is_closed() -> bool {
    before_main::WAS_CLOSED.load(std::sync::atomic::Ordering::Relaxed)
}

/// On other systems a write to a closed standard output fails as any other.
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
        /// One system call and one store: it runs before the runtime of `main` is set up.
        #[ctor(unsafe)]
        fn look() {
            let is_closed = fcntl_getfd(stdout()) == Err(Errno::BADF);
            WAS_CLOSED.store(is_closed, Ordering::Relaxed);
        }
    }
}

/// From now on a write beyond the limit of file sizes (`ulimit -f`) fails instead of ending the program: the error is reported, and the
/// incomplete file removed.
#[cfg(unix)]
pub(crate) fn refuse_to_end_at_the_limit_of_file_sizes() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use signal_hook::{consts::SIGXFSZ, flag};

    // The write returns the error; if the handler cannot be set, the signal ends the program as by default.
    drop(flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false))));
}

/// Other systems have no such signal.
#[cfg(not(unix))]
pub(crate) fn refuse_to_end_at_the_limit_of_file_sizes() {}
