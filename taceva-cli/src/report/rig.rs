//! Reports of checks of a rig.

use std::io::{self, Write};

use serde::Serialize;
use taceva_acquire::{RigCheck, RigProblem, RigTap, RigWeight, Stream};
use taceva_core::counted;
use taceva_protocol::{Contact, calm_threshold_n};

use crate::args::ListFormat;

/// Content of the JSON with the schema `taceva.rig-check/1`.
#[derive(Serialize)]
struct WrittenCheck<'a> {
    schema: &'static str,
    #[serde(flatten)]
    check: &'a RigCheck,
}

/// Content of the JSON with the schema `taceva.rig-tap/1`.
#[derive(Serialize)]
struct WrittenTap<'a> {
    schema: &'static str,
    #[serde(flatten)]
    tap: &'a RigTap,
}

/// Content of the JSON with the schema `taceva.rig-weight/1`.
#[derive(Serialize)]
struct WrittenWeight<'a> {
    schema: &'static str,
    #[serde(flatten)]
    found: &'a RigWeight,
}

pub(crate) fn tap(tap: &RigTap, format: ListFormat, out: &mut dyn Write) -> io::Result<()> {
    let RigTap {
        taps,
        dropped,
        late,
        before_ms,
        force,
        sensor,
        latencies,
        ..
    } = tap;
    if let ListFormat::Json = format {
        let schema = "taceva.rig-tap/1";
        serde_json::to_writer_pretty(&mut *out, &WrittenTap { schema, tap })?;
        return writeln!(out);
    }
    unmeasured(tap.simulated, out)?;
    writeln!(
        out,
        "{taps} clear taps; with the present corrections of the stamps:"
    )?;
    for why in dropped {
        writeln!(out, "left out: {why}")?;
    }
    if *late > 0 {
        let all = counted(taps + dropped.len(), "tap");
        writeln!(
            out,
            "late: {late} of {all}, so the latency may be longer than the other taps show; at most a fifth may be late"
        )?;
    }
    for (device, latency) in [("force", force), ("sensor", sensor)] {
        writeln!(
            out,
            "{device:<7} {:+.1} ms after the robot (± {:.2} ms; single tap ± {:.2} ms)",
            latency.after_robot_ms, latency.error_ms, latency.spread_ms
        )?;
    }
    let now_ms = [
        ("robot", latencies.robot_ms.unwrap_or(before_ms[0])),
        ("force", latencies.force_ms),
        ("sensor", latencies.sensor_ms),
    ];
    for ((device, now_ms), before_ms) in now_ms.into_iter().zip(before_ms) {
        writeln!(
            out,
            "[{device}] latency_ms = {now_ms:.1} (before {before_ms:.1})"
        )?;
    }
    for (name, value) in &tap.settings {
        writeln!(out, "setting {name} = {value}")?;
    }
    Ok(())
}

pub(crate) fn weight(found: &RigWeight, format: ListFormat, out: &mut dyn Write) -> io::Result<()> {
    if let ListFormat::Json = format {
        let schema = "taceva.rig-weight/1";
        serde_json::to_writer_pretty(&mut *out, &WrittenWeight { schema, found })?;
        return writeln!(out);
    }
    unmeasured(found.simulated, out)?;
    let [x_n, y_n, z_n] = found.change_n;
    let weighing = &found.weighing;
    writeln!(
        out,
        "change  ({x_n:.4}, {y_n:.4}, {z_n:.4}) N along x, y and z under {} g",
        weighing.mass_g
    )?;
    match &found.problem {
        Some(problem) => writeln!(out, "problem {problem}"),
        None => writeln!(
            out,
            "force   ok: Fz changed by {:.4} N, expected {:.4} ± {:.4} N",
            weighing.measured_n, weighing.expected_n, weighing.tolerance_n
        ),
    }
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

/// Writes the remark that an emulated rig gives no measurements.
fn unmeasured(is_simulated: bool, out: &mut dyn Write) -> io::Result<()> {
    match is_simulated {
        true => writeln!(out, "Nothing here was measured: the devices are simulated."),
        false => Ok(()),
    }
}

fn text(check: &RigCheck, out: &mut dyn Write) -> io::Result<()> {
    unmeasured(check.simulated, out)?;
    let streams = [
        ("force", &check.force, "N"),
        ("robot", &check.robot, "mm"),
        ("sensor", &check.sensor, ""),
    ];
    for (device, stream, unit) in streams {
        match (failure(check, device), stream) {
            (Some(failure), _) => writeln!(out, "{device:<7} error: {failure}")?,
            (None, Some(stream)) => {
                write!(out, "{device:<7} {}: ", state(check, device))?;
                measured(stream, unit, out)?;
            }
            (None, None) => writeln!(out, "{device:<7} is not in the rig file")?,
        }
    }
    match (failure(check, "switch"), &check.switch) {
        (Some(failure), _) => writeln!(out, "switch  error: {failure}")?,
        (None, Some(switch)) => {
            let share = 100.0 * f64::from(switch.held) / f64::from(switch.looks.max(1));
            writeln!(
                out,
                "switch  {}: held in {} of {} ({share:.0} %), pressed or released {}, answers within {:.3} ms",
                state(check, "switch"),
                switch.held,
                counted(switch.looks, "reading"),
                counted(switch.changes, "time"),
                switch.longest_ms
            )?;
        }
        (None, None) => {}
    }
    for key in ["specimen", "unit", "light"] {
        if let Some(failure) = failure(check, key) {
            writeln!(out, "{key:<7} error: {failure}")?;
        }
        for stock in check.changers.iter().filter(|stock| stock.key == key) {
            writeln!(out, "{key:<7} ok: holds {}", stock.holds.join(", "))?;
        }
    }
    match (&check.halt, &check.halt_left_out) {
        (Some(halt), _) => writeln!(
            out,
            "halt    acknowledged in {:.1} ms, the robot stopped in {:.1} ms; the tip was left {:.2} mm higher",
            halt.acknowledged_ms, halt.ended_ms, halt.left_mm
        )?,
        (None, Some(why)) => writeln!(out, "halt    skipped: {why}")?,
        (None, None) => {}
    }
    let noise_n = check.force.as_ref().and_then(|force| force.noise);
    if let Some(line) = noise_n.and_then(threshold) {
        writeln!(out, "note    {line}")?;
    }
    for (name, value) in &check.settings {
        writeln!(out, "setting {name} = {value}")?;
    }
    for warning in &check.warnings {
        writeln!(out, "warning {warning}")?;
    }
    let measured = check.problems.iter();
    for problem in measured.filter(|problem| !problem.is_failure()) {
        writeln!(out, "problem {problem}")?;
    }
    Ok(())
}

/// Remark on force noise, compared with the default threshold of a scene. `None` if 5 times the noise is below the threshold.
fn threshold(noise_n: f64) -> Option<String> {
    let default_n = Contact::default().threshold_n.value;
    let calm_n = calm_threshold_n(noise_n, default_n)?;
    Some(format!(
        "5 times the noise of the force, {:.3} N, exceeds the default `threshold_N` of {default_n} N, so noise would halt motions in the air: write threshold_N = {calm_n} under [protocol.contact] of the scene",
        5.0 * noise_n
    ))
}

/// Failure of `device`; `None` if the device was measured.
fn failure<'a>(check: &'a RigCheck, device: &str) -> Option<&'a RigProblem> {
    let mut failures = check.problems.iter().filter(|problem| problem.is_failure());
    failures.find(|problem| problem.device() == Some(device))
}

/// State of a measured `device`, as a word.
fn state(check: &RigCheck, device: &str) -> &'static str {
    let mut problems = check.problems.iter();
    match problems.any(|problem| problem.device() == Some(device)) {
        true => "problem",
        false => "ok",
    }
}

fn measured(stream: &Stream, unit: &str, out: &mut dyn Write) -> io::Result<()> {
    write!(
        out,
        "{:.1} Hz, longest pause {:.1} ms, readings arrive at most {:.1} ms after their stamp",
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_above_a_fifth_of_the_threshold_names_the_key_and_its_value() {
        let said = threshold(0.0042).unwrap_or_default();
        assert!(
            said.contains("write threshold_N = 0.05 under [protocol.contact]"),
            "{said}"
        );
        assert_eq!(threshold(0.001), None);
    }
}
