//! `taceva watch`.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::Context as _;
use taceva_acquire::{Viewer, preview};
use taceva_core::{Axis, Frame, Pose, Progress, Wrench, counted, shown};
use taceva_dataset::StreamFacts;
use taceva_protocol::{ContentId, Event, Plan};
use taceva_stress::{Alarm, Monitor, watch};

use super::capture::open;
use super::{Context, Usage, open_seen};
use crate::args::Watch;
use crate::{exit, output};

/// Force below which the gel is untouched, and above which it is touched, N. Pictures with a force between both are not watched.
const UNTOUCHED_N: f64 = 0.05;
const TOUCHED_N: f64 = 0.1;
/// Number of untouched pictures after a contact that are not watched: pictures arrive later than forces, and the gel recovers.
const RECOVERY: u32 = 10;

pub(crate) fn run(args: &Watch, context: &Context) -> anyhow::Result<u8> {
    let model = context.models()?.open(&args.model)?;
    let seen = |path: &PathBuf| open_seen(std::slice::from_ref(path), &args.view, Some(&model));
    let Some(path) = args.calibration.as_ref().or(args.recording.as_ref()) else {
        return Err(Usage::error(
            "--calibration: expected the recording of the calibration, because a change is compared with the change by contact in that recording",
        ));
    };
    let calibration = seen(path)?;
    let recording = args.recording.as_ref().map(seen).transpose()?;
    let applied = || super::applied(&args.model, std::slice::from_ref(path));
    let monitor = Monitor::of(&calibration)?;
    let mut monitor = monitor
        .with_model(model, &calibration)
        .with_context(applied)?;
    let work = context.work(None);
    let is_known = args.calibration.is_some() && !args.fresh;
    if is_known {
        monitor.learn_from(&calibration, work)?;
        say_what_is_known(&monitor, path, context);
    }
    let monitor = match &recording {
        None => watch_sensor(args, monitor, context)?,
        Some(recording) => {
            let mut written = Ok(());
            watch(recording, &mut monitor, work, &mut |sample, alarm| {
                if written.is_ok() {
                    written = line(&format!("{}: {alarm}", shown(sample)));
                }
            })?;
            written?;
            monitor
        }
    };
    summarise(&monitor, context);
    Ok(match monitor.found().is_empty() && monitor.is_decided() {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}

/// Prints the changes that untouched pictures of the calibration can show, if these pictures are fewer than usual.
fn say_what_is_known(monitor: &Monitor, path: &Path, context: &Context) {
    let pictures = monitor.calibration_pictures().unwrap_or_default();
    if pictures >= Monitor::PICTURES {
        return;
    }
    let known = format!(
        "{}: {} in the calibration, expected {}",
        shown(path),
        counted(pictures, "untouched picture"),
        Monitor::PICTURES
    );
    match monitor.smallest() {
        Some([level, pattern, detail, lines]) => context.say(format_args!(
            "{known}; smallest changes found, relative to the change by contact: brightness {level:.2}, large parts {pattern:.2}, detail {detail:.2}, single lines {lines:.2}"
        )),
        None => context.say(format_args!(
            "{known}: a change since then is found only if it exceeds the change by contact; the first {} watched pictures set the limits for later changes",
            monitor.missing()
        )),
    }
}

/// Watches the sensor of the arguments.
fn watch_sensor(args: &Watch, monitor: Monitor, context: &Context) -> anyhow::Result<Monitor> {
    let (_, mut live) = open(&args.live, context)?;
    let has_force = live.measures(Axis::Fz);
    let call = match has_force {
        true => "touch nothing until the force has its zero",
        false => "no force is measured, so every picture counts as untouched: touch nothing",
    };
    context.say(format_args!("{call}; Ctrl-C ends the watch"));
    let watcher = Watcher(Mutex::new(Watched {
        monitor,
        has_force,
        normal_n: None,
        recovering: RECOVERY,
        left: args.frames,
        failure: None,
    }));
    let until = Until {
        watcher: &watcher,
        progress: &context.progress,
    };
    preview(&mut live, &watcher, None, &until)?;
    let Watched {
        monitor, failure, ..
    } = watcher
        .0
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner);
    if let Some(failure) = failure {
        return Err(failure);
    }
    if monitor.missing() > 0 {
        anyhow::bail!(
            "nothing was watched: {} more untouched pictures are needed to set the limits; set a larger --frames, or name a recording \
             with {} untouched pictures after --calibration",
            monitor.missing(),
            Monitor::LEAST_PICTURES
        );
    }
    Ok(monitor)
}

/// Prints a line of the result.
fn line(words: &str) -> anyhow::Result<()> {
    output::write(None, |out| writeln!(out, "{words}"))
}

fn summarise(monitor: &Monitor, context: &Context) {
    let [untouched, touched] = monitor.pictures();
    let changes = match monitor.found().len() {
        0 if monitor.is_decided() => "no change".to_owned(),
        0 => undecided(monitor),
        count => format!(
            "{}; after a new untouched picture, watch with --calibration and --fresh",
            counted(count, "change")
        ),
    };
    context.say(format_args!(
        "{} and {touched} of contact: {changes}",
        counted(untouched, "untouched picture")
    ));
    if let Some([level, pattern, detail, lines]) = monitor.smallest() {
        context.say(format_args!(
            "smallest changes that are found, relative to the change by contact: brightness {level:.2}, large parts {pattern:.2}, detail {detail:.2}, single lines {lines:.2}"
        ));
    }
}

/// Sentence for a watch with too few untouched pictures to decide if anything changed.
fn undecided(monitor: &Monitor) -> String {
    let least = Monitor::LEAST_PICTURES;
    let few = "not enough untouched pictures to decide";
    match monitor.calibration_pictures() {
        Some(pictures) if pictures < least => format!(
            "{few} if anything changed since the calibration. The calibration has {pictures}, expected at least {least}: record the untouched sensor for longer, and name that recording after --calibration"
        ),
        _ => format!("{few}, expected at least 30 beyond those that set the limits"),
    }
}

/// Viewer that passes pictures to a monitor.
struct Watcher(Mutex<Watched>);

struct Watched {
    monitor: Monitor,
    has_force: bool,
    /// Normal force of the newest reading, N; `None` before the first reading.
    normal_n: Option<f64>,
    /// Number of next untouched pictures to skip, because the gel is still recovering from a contact.
    recovering: u32,
    /// Number of remaining pictures; `None` to continue until Ctrl-C.
    left: Option<u64>,
    failure: Option<anyhow::Error>,
}

impl Watcher {
    fn watched(&self) -> MutexGuard<'_, Watched> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Watched {
    fn is_over(&self) -> bool {
        self.failure.is_some() || self.left == Some(0)
    }

    fn take(&mut self, frame: &Frame) -> anyhow::Result<()> {
        let alarms: Vec<Alarm> = match (self.has_force, self.normal_n) {
            (false, _) => self.monitor.untouched(frame)?,
            (true, Some(normal_n)) if normal_n.abs() < UNTOUCHED_N => match self.recovering {
                0 => self.monitor.untouched(frame)?,
                _ => {
                    self.recovering -= 1;
                    Vec::new()
                }
            },
            (true, Some(normal_n)) => {
                self.recovering = RECOVERY;
                match normal_n.abs() > TOUCHED_N {
                    true => self.monitor.touched(frame)?,
                    false => Vec::new(),
                }
            }
            (true, None) => Vec::new(),
        };
        alarms.iter().try_for_each(|alarm| line(&alarm.to_string()))
    }
}

impl Viewer for Watcher {
    fn begins(&self, _: &Plan, _: &str, _: &dyn Fn(ContentId) -> bool) {}

    fn event(&self, _: &Event) {}

    fn frame(&self, frame: &Frame) {
        let mut watched = self.watched();
        if watched.is_over() {
            return;
        }
        if let Err(error) = watched.take(frame) {
            watched.failure = Some(error);
        }
        watched.left = watched.left.map(|left| left - 1);
    }

    fn force(&self, wrench: &Wrench) {
        self.watched().normal_n = Some(wrench.force[2].0);
    }

    fn pose(&self, _: &Pose) {}

    fn lost(&self, _: StreamFacts) {}
}

/// Progress that is also cancelled once the watcher has its last picture.
struct Until<'a> {
    watcher: &'a Watcher,
    progress: &'a dyn Progress,
}

impl Progress for Until<'_> {
    fn is_cancelled(&self) -> bool {
        self.progress.is_cancelled() || self.watcher.watched().is_over()
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, Newton, PixelFormat};

    use super::*;

    #[test]
    fn pictures_just_after_a_contact_and_between_the_limits_are_not_watched() {
        let info = FrameInfo {
            width: 2,
            height: 2,
            format: PixelFormat::Gray8,
        };
        let frame = Frame::new(info, vec![9; 4]).expect("whole");
        let watcher = Watcher(Mutex::new(Watched {
            monitor: Monitor::new(frame.clone(), 0.1).expect("a monitor"),
            has_force: true,
            normal_n: None,
            recovering: RECOVERY,
            left: None,
            failure: None,
        }));
        for force in [0.0, 2.0, 0.0, 0.07] {
            watcher.force(&Wrench {
                force: [Newton(0.0), Newton(0.0), Newton(force)],
                ..Wrench::default()
            });
            (0..12).for_each(|_| watcher.frame(&frame));
        }
        assert_eq!(watcher.watched().monitor.pictures(), [4, 12]);
    }
}
