//! `taceva capture`.

use std::path::Path;

use taceva_acquire::{
    CaptureRequest, CaptureStage, CaptureState, Captured, LiveDevices, LiveSpec, capture,
    close_capture,
};
use taceva_core::{Axis, shown};
use taceva_dataset::{Header, SensorFacts};

use super::Context;
use crate::args::{Capture, LiveArgs};
use crate::progress::{self, StatusLine};
use crate::{exit, stderr};

pub(crate) fn run(args: &Capture, context: &Context) -> anyhow::Result<u8> {
    if args.close {
        let header = close_capture(&args.path)?;
        context.say(format_args!(
            "closed {}: {} frames",
            shown(&args.path),
            header.table.rows
        ));
        return Ok(exit::DONE);
    }
    let (spec, mut live) = open(&args.live, context)?;
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
    let request = CaptureRequest {
        path: args.path.clone(),
        sensor,
        lasts: args.lasts,
        frames: args.frames,
    };
    let has_force = live.measures(Axis::Fz);
    let status = StatusLine::new(context.quiet);
    let mut is_begun = false;
    let done = capture(
        &mut live,
        &request,
        &context.progress,
        &mut |stage| match stage {
            CaptureStage::Zeroing => context.say(format_args!(
                "touch nothing: the frame without contact{} is taken",
                if has_force {
                    " and the zero of the force"
                } else {
                    ""
                }
            )),
            CaptureStage::Recording(state) => {
                if !std::mem::replace(&mut is_begun, true) {
                    context.say(format_args!("press; Ctrl-C ends it"));
                }
                status.show(&line(&state, has_force));
            }
            _ => {}
        },
    );
    status.clear();
    let Captured { state, header, .. } = done?;
    summarise(&state, &header, has_force, &args.path, context);
    let was_asked_for = args.lasts.is_some() || args.frames.is_some();
    Ok(match progress::is_stopped() && was_asked_for {
        true => exit::STOPPED,
        false => exit::DONE,
    })
}

/// The devices that the arguments name, open.
pub(super) fn open(args: &LiveArgs, context: &Context) -> anyhow::Result<(LiveSpec, LiveDevices)> {
    let spec = LiveSpec::new(
        args.sensor.as_deref(),
        args.force.as_deref(),
        args.rig.as_deref(),
    )?;
    let drivers = context.drivers(args.rig.as_deref())?;
    let live = spec.open(&drivers)?;
    Ok((spec, live))
}

/// `1203 frames, 60.0 a second, 0 lost, 14 contacts, Fz 1.25 N`.
fn line(state: &CaptureState, has_force: bool) -> String {
    let mut line = format!(
        "{} frames, {:.1} a second, {} lost",
        state.frames,
        state.rate_hz,
        state.stream.lost()
    );
    if has_force {
        line += &format!(", {} contacts", state.contacts);
        line += &match state.normal_n {
            Some(normal_n) => format!(", Fz {normal_n:.2} N"),
            None => ", Fz unknown".to_owned(),
        };
    }
    line
}

/// A force that is so far below 0 pulls, which no hand does to a gel, in N.
const PULLED_N: f64 = -0.3;

fn summarise(
    state: &CaptureState,
    header: &Header,
    has_force: bool,
    path: &Path,
    context: &Context,
) {
    let path = shown(path).to_string();
    let lost = match state.stream.lost() {
        0 => "none was lost".to_owned(),
        lost => format!(
            "{lost} were lost ({} dropped, {} damaged)",
            state.stream.dropped, state.stream.damaged
        ),
    };
    context.say(format_args!(
        "{path}: {} frames at {:.1} a second, {lost}",
        header.table.rows, state.rate_hz
    ));
    if !state.stream.numbered {
        context.say(format_args!(
            "the camera numbers no frames: one that was lost before it came is not counted"
        ));
    }
    if !has_force {
        return;
    }
    context.say(format_args!(
        "{} contacts; {} frames without a force",
        state.contacts, state.without_force
    ));
    if state.contacts == 0 && state.least_normal_n < PULLED_N {
        stderr::say(format_args!(
            "Fz went to {:.2} N and never above 0.1 N: the axis is the wrong way round; turn `axes` under [force] of the rig file",
            state.least_normal_n
        ));
    } else if state.contacts > 0 {
        context.say(format_args!(
            "next: taceva check {path}, then taceva evaluate {path} --model ridge"
        ));
    }
}
