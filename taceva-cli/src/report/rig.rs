//! What was found of a rig.

use std::io::{self, Write};

use serde::Serialize;
use taceva_study::{RigCheck, Stream};

use crate::args::ListFormat;

/// Schema `taceva.rig-check/1`.
#[derive(Serialize)]
struct WrittenCheck<'a> {
    schema: &'static str,
    #[serde(flatten)]
    check: &'a RigCheck,
}

pub(crate) fn check(check: &RigCheck, format: ListFormat, out: &mut dyn Write) -> io::Result<()> {
    match format {
        ListFormat::Json => {
            let schema = "taceva.rig-check/1";
            serde_json::to_writer_pretty(&mut *out, &WrittenCheck { schema, check })?;
            writeln!(out)
        }
        ListFormat::Text => text(check, out),
    }
}

fn text(check: &RigCheck, out: &mut dyn Write) -> io::Result<()> {
    let streams = [
        ("force", &check.force, "N"),
        ("robot", &check.robot, "mm"),
        ("sensor", &check.sensor, ""),
    ];
    for (device, stream, unit) in streams {
        match stream {
            Some(stream) => listed(device, stream, unit, out)?,
            None => writeln!(out, "{device:<7} is not in the rig file")?,
        }
    }
    match &check.halt {
        Some(halt) => writeln!(
            out,
            "halt    acknowledged in {:.1} ms, the robot stood in {:.1} ms; the tip was left {:.2} mm higher",
            halt.acknowledged_ms, halt.ended_ms, halt.left_mm
        )?,
        None => writeln!(out, "halt    not tried")?,
    }
    for problem in &check.problems {
        writeln!(out, "problem {problem}")?;
    }
    Ok(())
}

fn listed(device: &str, stream: &Stream, unit: &str, out: &mut dyn Write) -> io::Result<()> {
    write!(
        out,
        "{device:<7} {:.1} Hz, longest pause {:.1} ms, at most {:.1} ms late",
        stream.rate_hz, stream.gap_ms, stream.late_ms
    )?;
    if let Some(noise) = stream.noise {
        write!(out, ", noise {noise:.5} {unit}")?;
    }
    if let Some(lost) = stream.lost {
        write!(out, ", {lost} lost")?;
    }
    writeln!(out)
}
