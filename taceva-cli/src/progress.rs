//! Where long work is: a bar on a terminal, plain lines when piped, nothing with `--quiet`; and how Ctrl-C reaches it.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use taceva_core::Progress;

/// Set once by a signal, read by all work.
static STOPPED: AtomicBool = AtomicBool::new(false);

/// Listens for SIGINT and SIGTERM; a second one ends the program at once, since the first was not enough.
pub(crate) fn listen_for_signals() {
    let listening = ctrlc::set_handler(|| {
        if STOPPED.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(crate::exit::STOPPED));
        }
    });
    // Without a handler a signal ends the program as it always did: nothing half-written is ever read.
    drop(listening);
}

/// Whether a signal came.
pub(crate) fn is_stopped() -> bool {
    STOPPED.load(Ordering::SeqCst)
}

/// Progress on standard error.
pub(crate) struct Terminal {
    mode: Mode,
    bar: Mutex<Option<ProgressBar>>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    Quiet,
    Lines,
    Bar,
}

impl Terminal {
    pub(crate) fn new(quiet: bool) -> Terminal {
        let mode = match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => Mode::Quiet,
            (false, true) => Mode::Bar,
            (false, false) => Mode::Lines,
        };
        Terminal {
            mode,
            bar: Mutex::new(None),
        }
    }

    fn with_bar(&self, act: impl FnOnce(&mut Option<ProgressBar>)) {
        if let Ok(mut bar) = self.bar.lock() {
            act(&mut bar);
        }
    }
}

impl Progress for Terminal {
    #[expect(
        clippy::print_stderr,
        reason = "plain progress lines are for standard error"
    )]
    fn begin(&self, stage: &str, steps: Option<u64>) {
        match self.mode {
            Mode::Quiet => {}
            Mode::Lines => match steps {
                Some(steps) => eprintln!("taceva: {stage} ({steps})"),
                None => eprintln!("taceva: {stage}"),
            },
            Mode::Bar => self.with_bar(|bar| *bar = Some(draw(stage, steps))),
        }
    }

    fn advance(&self, steps: u64) {
        if self.mode == Mode::Bar {
            self.with_bar(|bar| bar.iter().for_each(|bar| bar.inc(steps)));
        }
    }

    fn end(&self) {
        if self.mode == Mode::Bar {
            self.with_bar(|bar| bar.take().iter().for_each(ProgressBar::finish_and_clear));
        }
    }

    fn is_cancelled(&self) -> bool {
        is_stopped()
    }
}

fn draw(stage: &str, steps: Option<u64>) -> ProgressBar {
    let (bar, template) = match steps {
        Some(steps) => (
            ProgressBar::new(steps),
            "{msg:<28} {wide_bar} {pos}/{len}  {eta}",
        ),
        None => (ProgressBar::new_spinner(), "{msg:<28} {spinner} {elapsed}"),
    };
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.set_message(stage.to_owned());
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
