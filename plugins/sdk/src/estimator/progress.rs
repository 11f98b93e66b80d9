//! Reports the progress of a fit to the host.

use std::ffi::c_void;
use std::sync::atomic::{AtomicBool, AtomicPtr, AtomicU64, Ordering};
use std::thread::{self, ThreadId};

use taceva_abi::Progress as Report;
use taceva_core::Progress;

/// Progress of a fit. Calls the host only from the thread that requested the fit. Other threads read its last answer.
pub(super) struct ReportedProgress {
    report: Report,
    context: AtomicPtr<c_void>,
    thread: ThreadId,
    done: AtomicU64,
    steps: AtomicU64,
    is_cancelled: AtomicBool,
}

impl ReportedProgress {
    pub(super) fn new(report: Report, context: *mut c_void) -> ReportedProgress {
        ReportedProgress {
            report,
            context: AtomicPtr::new(context),
            thread: thread::current().id(),
            done: AtomicU64::new(0),
            steps: AtomicU64::new(0),
            is_cancelled: AtomicBool::new(false),
        }
    }

    fn share(&self) -> f64 {
        match self.steps.load(Ordering::Relaxed) {
            0 => 0.0,
            steps => (self.done.load(Ordering::Relaxed) as f64 / steps as f64).min(1.0),
        }
    }

    #[expect(unsafe_code, reason = "a function of the host is called")]
    fn report_now(&self) {
        let Some(report) = self
            .report
            .filter(|_| thread::current().id() == self.thread)
        else {
            return;
        };
        // SAFETY: the host passes its own function and context, and its thread of this call waits for the fit.
        let answer = unsafe { report(self.context.load(Ordering::Relaxed), self.share()) };
        if answer != 0 {
            self.is_cancelled.store(true, Ordering::Release);
        }
    }
}

impl Progress for ReportedProgress {
    fn begin(&self, _: &str, steps: Option<u64>) {
        self.done.store(0, Ordering::Relaxed);
        self.steps.store(steps.unwrap_or(0), Ordering::Relaxed);
        self.report_now();
    }

    fn advance(&self, steps: u64) {
        self.done.fetch_add(steps, Ordering::Relaxed);
        self.report_now();
    }

    fn end(&self) {
        self.report_now();
    }

    fn is_cancelled(&self) -> bool {
        self.report_now();
        self.is_cancelled.load(Ordering::Acquire)
    }
}
