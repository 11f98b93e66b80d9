//! Shows progress of long work: a bar on a terminal, plain lines in a pipe, nothing with `--quiet`. Also handles Ctrl-C.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use taceva_core::{Progress, shown};

use crate::stderr;

/// True after the first signal. All long work reads this flag.
static STOPPED: AtomicBool = AtomicBool::new(false);
/// True after a second signal.
static INSISTED: AtomicBool = AtomicBool::new(false);
/// Progress bar on the terminal; `None` if no bar is drawn.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);
/// Time for a robot to halt before the program ends.
const HALTING: Duration = Duration::from_millis(250);

/// Stops work on SIGINT and SIGTERM: a robot leaves the gel, and the recording is complete. A second signal halts the robot in place and ends the
/// program. With a `patience`, the program ends at the latest after this time.
pub(crate) fn listen_for_signals(patience: Option<Duration>) {
    let listening = ctrlc::set_handler(move || {
        if STOPPED.swap(true, Ordering::SeqCst) {
            INSISTED.store(true, Ordering::SeqCst);
            std::thread::sleep(HALTING);
            std::process::exit(i32::from(crate::exit::STOPPED));
        }
        if let Some(patience) = patience {
            // Where no thread can be started, a second signal ends the program.
            drop(std::thread::Builder::new().spawn(move || end_after(patience)));
        }
    });
    // Without a handler a signal ends the program as by default: incomplete files are never read.
    drop(listening);
}

/// Ends the program after `patience`, if it still runs. Only for work without devices that writes files atomically.
fn end_after(patience: Duration) {
    std::thread::sleep(patience);
    taceva_files::remove_before_exit();
    stderr::say(format_args!("stopped on request"));
    std::process::exit(i32::from(crate::exit::STOPPED));
}

/// Stops work like a signal, for the stop button of a page. A second call halts a robot in place. The program then ends with the run.
pub(crate) fn stop() {
    if STOPPED.swap(true, Ordering::SeqCst) {
        INSISTED.store(true, Ordering::SeqCst);
    }
}

/// True after a signal, or after [`stop`] was called.
pub(crate) fn is_stopped() -> bool {
    STOPPED.load(Ordering::SeqCst)
}

/// Progress on standard error.
pub(crate) struct TerminalProgress {
    mode: Mode,
    is_verbose: bool,
    pace: Mutex<Option<Pace>>,
}

/// Interval between two plain lines of progress.
const EVERY: Duration = Duration::from_secs(30);

/// Progress of one stage that is shown in plain lines.
struct Pace {
    stage: String,
    steps: Option<u64>,
    done: u64,
    begun: Instant,
    said: Instant,
}

impl Pace {
    fn new(stage: &str, steps: Option<u64>) -> Pace {
        let now = Instant::now();
        Pace {
            stage: stage.to_owned(),
            steps,
            done: 0,
            begun: now,
            said: now,
        }
    }

    /// Adds `steps` to the count. Returns a line if it is time to print a line.
    fn advance(&mut self, steps: u64, now: Instant) -> Option<String> {
        self.done = self.done.saturating_add(steps);
        if now.duration_since(self.said) < EVERY {
            return None;
        }
        self.said = now;
        let stage = &self.stage;
        let Some(all) = self.steps else {
            return Some(format!("{stage}: {}", self.done));
        };
        let left = left(self.done, all, now.duration_since(self.begun));
        let left = left.map_or_else(String::new, |left| format!(", about {} left", spoken(left)));
        Some(format!("{stage}: {} of {all}{left}", self.done))
    }
}

/// Estimated remaining time at the current pace; `None` before the first step and in the first second.
fn left(done: u64, all: u64, elapsed: Duration) -> Option<Duration> {
    if done == 0 || done > all || elapsed < Duration::from_secs(1) {
        return None;
    }
    let share = (all - done) as f64 / done as f64;
    Duration::try_from_secs_f64(elapsed.as_secs_f64() * share).ok()
}

/// Duration as text: `40 s`, `12 min`, `3 h 5 min`.
pub(crate) fn spoken(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..=89 => format!("{seconds} s"),
        90..=5399 => format!("{} min", seconds.div_ceil(60)),
        _ => {
            let minutes = seconds.div_ceil(60);
            format!("{} h {} min", minutes / 60, minutes % 60)
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    Quiet,
    Lines,
    Bar,
}

impl Mode {
    fn of(quiet: bool) -> Mode {
        match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => Mode::Quiet,
            (false, true) => Mode::Bar,
            (false, false) => Mode::Lines,
        }
    }
}

impl TerminalProgress {
    /// Creates the progress. Plain lines for stages of one step are printed only if `is_verbose`.
    pub(crate) fn new(quiet: bool, is_verbose: bool) -> TerminalProgress {
        TerminalProgress {
            mode: Mode::of(quiet),
            is_verbose,
            pace: Mutex::new(None),
        }
    }

    /// Calls `act` with the stage that plain lines report.
    fn with_pace(&self, act: impl FnOnce(&mut Option<Pace>)) {
        if let Ok(mut pace) = self.pace.lock() {
            act(&mut pace);
        }
    }
}

fn with_bar(act: impl FnOnce(&mut Option<ProgressBar>)) {
    if let Ok(mut bar) = BAR.lock() {
        act(&mut bar);
    }
}

/// Calls `ask` without drawing a bar, so that a question and its answer are readable.
pub(crate) fn without_bar<T>(ask: impl FnOnce() -> T) -> T {
    let bar = BAR.lock().ok().and_then(|bar| bar.clone());
    match bar {
        Some(bar) => bar.suspend(ask),
        None => ask(),
    }
}

impl Progress for TerminalProgress {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        match self.mode {
            Mode::Quiet => {}
            Mode::Lines => {
                self.with_pace(|pace| *pace = Some(Pace::new(stage, steps)));
                if let Some(line) = first_line(stage, steps, self.is_verbose) {
                    stderr::say(format_args!("{line}"));
                }
            }
            Mode::Bar => with_bar(|bar| *bar = Some(draw(stage, steps))),
        }
    }

    fn advance(&self, steps: u64) {
        match self.mode {
            Mode::Quiet => {}
            Mode::Bar => with_bar(|bar| bar.iter().for_each(|bar| bar.inc(steps))),
            Mode::Lines => self.with_pace(|pace| {
                let now = Instant::now();
                if let Some(words) = pace.as_mut().and_then(|pace| pace.advance(steps, now)) {
                    stderr::say(format_args!("{words}"));
                }
            }),
        }
    }

    fn end(&self) {
        if self.mode == Mode::Bar {
            with_bar(|bar| bar.take().iter().for_each(ProgressBar::finish_and_clear));
        }
    }

    fn is_cancelled(&self) -> bool {
        is_stopped()
    }

    fn is_insisted(&self) -> bool {
        INSISTED.load(Ordering::SeqCst)
    }

    /// Prints the line even with `--quiet`. Does not use the lock of the bar, which is held during a question.
    fn remark(&self, words: &str) {
        stderr::say(format_args!("{words}"));
    }
}

/// Plain line at the start of a stage: `leaving groups out (13)`. `None` for a stage of one step, unless `is_verbose`.
fn first_line(stage: &str, steps: Option<u64>, is_verbose: bool) -> Option<String> {
    match steps {
        Some(0 | 1) if !is_verbose => None,
        Some(steps) => Some(format!("{stage} ({steps})")),
        None => Some(stage.to_owned()),
    }
}

/// Status line on standard error for work without a known end. Updated in place on a terminal, otherwise printed every 30 s.
pub(crate) struct StatusLine {
    mode: Mode,
    bar: ProgressBar,
    said: Mutex<Option<Instant>>,
}

impl StatusLine {
    pub(crate) fn new(quiet: bool) -> StatusLine {
        let mode = Mode::of(quiet);
        let bar = match mode {
            Mode::Bar => ProgressBar::new_spinner(),
            Mode::Quiet | Mode::Lines => ProgressBar::hidden(),
        };
        if let Ok(style) = ProgressStyle::with_template("{msg}") {
            bar.set_style(style);
        }
        bar.set_draw_target(match mode {
            Mode::Bar => ProgressDrawTarget::stderr_with_hz(5),
            Mode::Quiet | Mode::Lines => ProgressDrawTarget::hidden(),
        });
        StatusLine {
            mode,
            bar,
            said: Mutex::new(None),
        }
    }

    pub(crate) fn show(&self, line: &str) {
        match self.mode {
            Mode::Quiet => {}
            Mode::Bar => self.bar.set_message(shown(line).to_string()),
            Mode::Lines => {
                let Ok(mut said) = self.said.lock() else {
                    return;
                };
                let now = Instant::now();
                let began = *said.get_or_insert(now);
                if now.duration_since(began) >= EVERY {
                    *said = Some(now);
                    stderr::say(format_args!("{line}"));
                }
            }
        }
    }

    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn draw(stage: &str, steps: Option<u64>) -> ProgressBar {
    let (bar, template) = match steps {
        Some(steps) => (
            ProgressBar::new(steps),
            "{msg:<28} {wide_bar} {pos}/{len}  {left}",
        ),
        None => (ProgressBar::new_spinner(), "{msg:<28} {spinner} {elapsed}"),
    };
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template(template) {
        // Shows nothing while the time is unknown; a bar would show 0 s.
        let left = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let all = state.len().unwrap_or(0);
            let words = left(state.pos(), all, state.elapsed()).map(spoken);
            let words = words.unwrap_or_else(|| "…".to_owned());
            // A write error must not stop the work.
            let _ = write!(out, "{words} left");
        };
        bar.set_style(style.with_key("left", left));
    }
    bar.set_message(shown(stage).to_string());
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

#[cfg(test)]
mod tests;
