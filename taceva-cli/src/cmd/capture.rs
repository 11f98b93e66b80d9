//! `taceva capture`.

use std::path::Path;

use taceva_acquire::{
    CaptureRequest, CaptureStage, CaptureState, Captured, LiveDevices, LivePredictor, LiveSpec,
    Onlookers, Viewer, capture, close_capture, read_rig,
};
use taceva_core::{Axis, by_count, counted, shown};
use taceva_dataset::{Header, SensorFacts};
use taceva_protocol::SignedAxes;

use super::Context;
use super::device_page::OnPage;
use super::live_predictions::{LivePredictions, read_model};
use crate::args::{Capture, LiveArgs};
use crate::progress::{self, StatusLine, spoken};
use crate::{exit, stderr};

pub(crate) fn run(args: &Capture, context: &Context) -> anyhow::Result<u8> {
    if args.close {
        let header = close_capture(&args.path)?;
        context.say(format_args!(
            "closed {}: {}",
            shown(&args.path),
            counted(header.table.rows, "frame")
        ));
        return Ok(exit::DONE);
    }
    let model = args.model.as_deref();
    let model = model.map(|path| read_model(path, context)).transpose()?;
    let (spec, mut live) = open(&args.live, context)?;
    let warned = live.warnings();
    if let Some(model) = &model {
        model.check(live.frame_info())?;
    }
    let driver = || spec.sensor().driver().to_owned();
    let mut sensor = SensorFacts::new(args.name.clone().unwrap_or_else(driver));
    if let Some(serial) = &args.serial {
        sensor = sensor.with_serial(serial);
    }
    if let Some(gel) = &args.gel {
        sensor = sensor.with_gel(gel);
    }
    if let Some(opaque) = live.sensor_facts().opaque {
        sensor = sensor.with_opaque(opaque);
    }
    // A device that an option names instead has neither the axes nor the latency of the rig file.
    let LiveArgs {
        sensor: of_sensor,
        force: of_force,
        ..
    } = &args.live;
    let rig = args.live.rig.as_deref().map(read_rig).transpose()?;
    let of_rig = rig.as_ref();
    let laboratory = of_rig.and_then(|rig| rig.laboratory.clone());
    let operator = of_rig.and_then(|rig| rig.operator_name.clone());
    let stated = [
        ("laboratory", args.laboratory.clone().or(laboratory)),
        ("operator", args.operator.clone().or(operator)),
    ];
    let stated = stated.into_iter();
    let stated = stated.filter_map(|(key, name)| Some((key.to_owned(), name?)));
    let request = CaptureRequest {
        rig: rig.filter(|_| of_sensor.is_none() && of_force.is_none()),
        path: args.path.clone(),
        sensor,
        lasts: args.lasts,
        frames: args.frames,
        stated: stated.collect(),
    };
    let has_force = live.measures(Axis::Fz);
    let page = match &model {
        None => None,
        Some(_) => Some(OnPage::open(
            &format!("capture of {}", spec.sensor().driver()),
            args.port,
        )?),
    };
    if let Some(page) = &page {
        stderr::say(format_args!("page: {}", page.url()));
    }
    let shown = model.as_ref().zip(page.as_ref());
    let shown = shown.map(|(model, page)| LivePredictions::new(model, page.live(), context));
    let heard = |frame: &_, prediction: &_, counts: &_| {
        if let Some(shown) = &shown {
            shown.show(frame, prediction, counts);
        }
    };
    let predictor = model
        .as_ref()
        .map(|model| LivePredictor::new(model, &heard).with_table());
    let viewer = page.as_ref().map(OnPage::viewer);
    let mut onlookers = Onlookers::none();
    onlookers.viewer = viewer.as_deref().map(|viewer| viewer as &dyn Viewer);
    onlookers.predictor = predictor.as_ref();
    let stage = |words: &str| {
        if let Some(page) = &page {
            page.live().stage(words);
        }
    };
    let status = StatusLine::new(context.quiet);
    let mut is_begun = false;
    let done = capture(
        &mut live,
        &request,
        onlookers,
        &context.progress,
        &mut |of| match of {
            CaptureStage::Zeroing => {
                let zero = match has_force {
                    true => " and the zero of the force",
                    false => "",
                };
                let words = format!("touch nothing: recording the frame without contact{zero}");
                stage(&words);
                context.say(format_args!("{words}"));
            }
            CaptureStage::Recording(state) => {
                if !std::mem::replace(&mut is_begun, true) && !is_complete(args, &state) {
                    stage("recording: press");
                    context.say(format_args!("{}", call_to_press(args)));
                }
                let predicted = shown
                    .as_ref()
                    .map_or_else(String::new, |shown| format!("; {}", shown.line()));
                status.show(&format!("{}{predicted}", line(&state, has_force)));
            }
            _ => {}
        },
    );
    status.clear();
    if let Some(page) = &page {
        page.live().ended(&match &done {
            Ok(_) => "the capture has ended; the dataset is complete".to_owned(),
            Err(error) => error.to_string(),
        });
    }
    if let (Some(shown), Some(predictor)) = (&shown, &predictor) {
        shown.summarise(&predictor.counts(), context);
        if let Some(problem) = predictor.failure() {
            stderr::say(format_args!(
                "the model failed and stopped predicting: {problem}; frames and forces were still recorded"
            ));
        }
    }
    for warning in live
        .warnings()
        .iter()
        .filter(|warning| !warned.contains(warning))
    {
        stderr::say(format_args!("warning: {warning}"));
    }
    let Captured { state, header, .. } = done?;
    summarise(&state, &header, &spec, has_force, &args.path, context);
    if let Some(predictions) = &header.predictions {
        context.say(format_args!(
            "{}/predictions.csv: {predictions}, {}; measured labels are only in samples.parquet",
            taceva_core::shown(&args.path),
            counted(predictions.rows, "frame")
        ));
    }
    let was_asked_for = args.lasts.is_some() || args.frames.is_some();
    Ok(match progress::is_stopped() && was_asked_for {
        true => exit::STOPPED,
        false => exit::DONE,
    })
}

/// Opens the devices of the arguments.
pub(super) fn open(args: &LiveArgs, context: &Context) -> anyhow::Result<(LiveSpec, LiveDevices)> {
    let spec = LiveSpec::new(
        args.sensor.as_deref(),
        args.force.as_deref(),
        args.rig.as_deref(),
    )?;
    let drivers = context.drivers(args.rig.as_deref())?;
    let live = spec.open(&drivers)?;
    if live.is_simulated() {
        context.say(format_args!(
            "nothing here is measured: the devices are simulated"
        ));
    }
    for warning in live.warnings() {
        stderr::say(format_args!("warning: {warning}"));
    }
    Ok((spec, live))
}

/// True if the frames in `state` are all that `args` asks for, so that no frame is awaited.
fn is_complete(args: &Capture, state: &CaptureState) -> bool {
    // NaN for a single frame, which takes no time.
    let passed_s = state.frames.saturating_sub(1) as f64 / state.rate_hz;
    let has_lasted = args.lasts.is_some_and(|of| passed_s >= of.as_secs_f64());
    has_lasted || args.frames.is_some_and(|frames| state.frames >= frames)
}

/// Line for the start of a recording, which states how to end it: `press; Ctrl-C ends the capture, or 20 frames`.
fn call_to_press(args: &Capture) -> String {
    let frames = args.frames.map(|frames| counted(frames, "frame"));
    let ends = frames.into_iter().chain(args.lasts.map(spoken));
    ends.fold("press; Ctrl-C ends the capture".to_owned(), |line, end| {
        format!("{line}, or {end}")
    })
}

/// Status line: `1203 frames, 60.0 a second, 0 lost, 14 contacts, Fz 1.25 N`.
fn line(state: &CaptureState, has_force: bool) -> String {
    let mut line = format!(
        "{}, {:.1} a second, {} lost",
        counted(state.frames, "frame"),
        state.rate_hz,
        state.stream.lost()
    );
    if has_force {
        line += &format!(", {}", counted(state.contacts, "contact"));
        line += &match state.normal_n {
            Some(normal_n) => format!(", Fz {normal_n:.2} N"),
            None => ", Fz unknown".to_owned(),
        };
    }
    line
}

/// Reasons for frames without a force: `: 1 before the first reading, 3 in gaps between readings`; empty if none is known.
fn causes(state: &CaptureState) -> String {
    let causes = [
        (state.before_force, "before the first reading"),
        (state.in_force_gaps, "in gaps between readings"),
        (state.late_force, "after which no reading came in time"),
    ];
    let causes = causes.into_iter().filter(|(count, _)| *count > 0);
    let causes: Vec<String> = causes
        .map(|(count, cause)| format!("{count} {cause}"))
        .collect();
    match causes.is_empty() {
        true => String::new(),
        false => format!(": {}", causes.join(", ")),
    }
}

/// Readings below this force, N, mean that the sign is wrong, because a hand does not pull a gel.
const PULLED_N: f64 = -0.3;

/// Remedy for a reversed Fz: the two possible `axes` of the rig file, and the push that decides between them.
fn righted(spec: &LiveSpec) -> String {
    // Without a rig file, the transducer has the frame of the sensor.
    let axes = spec.force_axes();
    let axes = axes.or_else(|| SignedAxes::read(["x", "y", "z"]).ok());
    let lines = axes.into_iter().flat_map(SignedAxes::turned_over);
    let lines: Vec<String> = lines.map(|axes| format!("`axes = {axes}`")).collect();
    format!(
        "write {}, whichever makes a push to the right of the picture raise Fx",
        lines.join(" or ")
    )
}

fn summarise(
    state: &CaptureState,
    header: &Header,
    spec: &LiveSpec,
    has_force: bool,
    path: &Path,
    context: &Context,
) {
    let path = shown(path).to_string();
    let lost = match state.stream.lost() {
        0 => "no frame was lost".to_owned(),
        lost => format!(
            "{lost} {} lost ({} dropped, {} damaged)",
            by_count(lost, "was", "were"),
            state.stream.dropped,
            state.stream.damaged
        ),
    };
    context.say(format_args!(
        "{path}: {} at {:.1} a second, {lost}",
        counted(header.table.rows, "frame"),
        state.rate_hz
    ));
    if !state.stream.numbered {
        context.say(format_args!(
            "the camera does not number its frames, so frames lost before they arrived are not counted"
        ));
    }
    if !has_force {
        return;
    }
    context.say(format_args!(
        "{}; {} without a force{}",
        counted(state.contacts, "contact"),
        counted(state.without_force, "frame"),
        causes(state)
    ));
    if state.contacts == 0 && state.least_normal_n < PULLED_N {
        stderr::say(format_args!(
            "Fz reached {:.2} N and never exceeded 0.1 N: the axis of Fz is reversed. Under [force] of the rig file, {}",
            state.least_normal_n,
            righted(spec)
        ));
    } else if state.contacts > 0 {
        context.say(format_args!(
            "next: taceva check {path}, then taceva evaluate {path} --model ridge"
        ));
    } else if state.without_force > 0 && state.without_force >= state.frames {
        stderr::say(format_args!(
            "warning: no frame has a force, so no contact was recorded; `taceva rig check` shows stamps of another clock and too low a rate"
        ));
    } else {
        // A transducer that repeats one number from its first reading on is not detected at rest.
        stderr::say(format_args!(
            "warning: Fz never exceeded 0.1 N, so no contact was recorded; if the gel was pressed, check the transducer, its cable and its amplifier"
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_without_a_force_are_shown_with_their_causes() {
        let with = |before, in_gaps, late| {
            let mut state = CaptureState::default();
            (state.before_force, state.in_force_gaps, state.late_force) = (before, in_gaps, late);
            causes(&state)
        };
        assert_eq!(with(0, 0, 0), "");
        assert_eq!(
            with(2, 3, 1),
            ": 2 before the first reading, 3 in gaps between readings, 1 after which no reading came in time"
        );
        assert_eq!(with(0, 4, 0), ": 4 in gaps between readings");
    }
}
