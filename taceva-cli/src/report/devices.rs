//! Drivers, devices and findings of `doctor`, as lists.

use std::io::{self, Write};

use serde::Serialize;
use taceva_core::counted;
use taceva_drivers::doctor::{Diagnosis, State};
use taceva_drivers::{Devices, ListedArgument, ListedDevice, ListedDriver, ListedSwitch};

use super::json;
use crate::args::ListFormat;

/// Writes drivers and devices.
pub(crate) fn list(devices: &Devices, format: ListFormat, out: &mut dyn Write) -> io::Result<()> {
    match format {
        ListFormat::Text => text(devices, out),
        ListFormat::Json => json::write(&WrittenDevices::of(devices), out),
    }
}

/// Writes the findings of `doctor`.
pub(crate) fn findings(
    findings: &[Diagnosis],
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == ListFormat::Json {
        let written = WrittenFindings {
            schema: "taceva.doctor/1",
            findings,
        };
        return json::write(&written, out);
    }
    for finding in findings {
        write!(
            out,
            "{:<8} {:<28} {}",
            word(finding.state),
            finding.subject,
            finding.detail
        )?;
        match &finding.remedy {
            Some(remedy) => writeln!(out, "; remedy: {remedy}")?,
            None => writeln!(out)?,
        }
    }
    let count = |state| {
        findings
            .iter()
            .filter(|finding| finding.state == state)
            .count()
    };
    writeln!(
        out,
        "{} good, {} absent, {}",
        count(State::Good),
        count(State::Absent),
        counted(count(State::Problem), "problem")
    )
}

fn word(state: State) -> &'static str {
    match state {
        State::Good => "good",
        State::Absent => "absent",
        State::Problem => "problem",
    }
}

#[derive(Serialize)]
struct WrittenDevices<'a> {
    schema: &'static str,
    drivers: &'a [ListedDriver],
    switches: &'a [ListedSwitch],
    found: &'a [ListedDevice],
    failed: Vec<String>,
}

impl WrittenDevices<'_> {
    fn of(devices: &Devices) -> WrittenDevices<'_> {
        WrittenDevices {
            schema: "taceva.devices/1",
            drivers: &devices.drivers,
            switches: &devices.switches,
            found: &devices.found,
            failed: devices.failed.iter().map(ToString::to_string).collect(),
        }
    }
}

#[derive(Serialize)]
struct WrittenFindings<'a> {
    schema: &'static str,
    findings: &'a [Diagnosis],
}

fn text(devices: &Devices, out: &mut dyn Write) -> io::Result<()> {
    for listed in &devices.drivers {
        driver(listed, out)?;
    }
    for switch in &devices.switches {
        let (key, kind, title) = (&switch.key, "switch", &switch.title);
        writeln!(
            out,
            "{key:<22} {kind:<9} real: {title}, `enable` under [operator] of a rig file"
        )?;
        arguments(&switch.arguments, out)?;
    }
    for device in &devices.found {
        let (selector, title) = (&device.selector, &device.title);
        writeln!(out, "present  {selector}   {title}: {}", device.access)?;
    }
    for error in &devices.failed {
        writeln!(out, "failed   {error}")?;
    }
    let drivers = counted(devices.drivers.len() + devices.switches.len(), "driver");
    let found = counted(devices.found.len(), "device");
    writeln!(out, "{drivers}, {found} present")
}

/// Writes one driver: key, facts about its device, and arguments.
pub(super) fn driver(driver: &ListedDriver, out: &mut dyn Write) -> io::Result<()> {
    let (key, kind) = (&driver.key, driver.kind.to_string());
    let source = driver.source.to_string();
    // The title of a simulated device may begin with the source, which is already printed.
    let title = driver.title.strip_prefix(&format!("{source} "));
    let title = title.unwrap_or(&driver.title);
    writeln!(out, "{key:<22} {kind:<9} {source}: {title}")?;
    let facts = facts(driver);
    if !facts.is_empty() {
        writeln!(out, "    {}", facts.join(", "))?;
    }
    arguments(&driver.arguments, out)
}

/// Writes the arguments of a driver, one on each line.
fn arguments(arguments: &[ListedArgument], out: &mut dyn Write) -> io::Result<()> {
    let lengths = arguments.iter().map(|argument| argument.key.len());
    let width = lengths.max().unwrap_or(0);
    for argument in arguments {
        describe(argument, width, out)?;
    }
    Ok(())
}

/// Facts about a device that are known before it is opened.
fn facts(driver: &ListedDriver) -> Vec<String> {
    let yes_no = |fact: Option<bool>, yes: &str, no: &str| {
        fact.map(|fact| if fact { yes } else { no }.to_owned())
    };
    let number = |value: Option<f64>, name: &str, unit: &str| {
        value.map(|value| format!("{name}{value} {unit}"))
    };
    let scenes = (!driver.scenes.is_empty()).then(|| format!("light {}", driver.scenes.join(" ")));
    let holds = (!driver.holds.is_empty()).then(|| format!("holds {}", driver.holds.join(", ")));
    [
        driver.frame.clone(),
        number(driver.rate_hz, "", "Hz"),
        yes_no(driver.opaque, "opaque", "lets light through"),
        yes_no(driver.markers, "markers", "no markers"),
        number(driver.depth_max_mm, "Pz up to ", "mm"),
        number(driver.force_max_n, "Fz up to ", "N"),
        driver.axes.clone(),
        number(driver.speed_max_mm_s, "up to ", "mm/s"),
        scenes,
        holds,
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Writes one argument, with the key in a column of `width` characters.
fn describe(argument: &ListedArgument, width: usize, out: &mut dyn Write) -> io::Result<()> {
    let presence = match (&argument.default, argument.required) {
        (Some(default), _) => format!(" [{default}]"),
        (None, true) => " (required)".to_owned(),
        (None, false) => String::new(),
    };
    let (key, takes, help) = (&argument.key, &argument.takes, &argument.help);
    writeln!(out, "    {key:<width$} {takes}{presence}: {help}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_of_this_machine_is_one_line_with_its_remedy() {
        let problem = Diagnosis {
            code: "plugin-quarantined",
            state: State::Problem,
            subject: "org.example.x".to_owned(),
            detail: "is in quarantine".to_owned(),
            remedy: Some("`taceva plugin release org.example.x`".to_owned()),
        };
        let mut out = Vec::new();
        findings(&[problem], ListFormat::Text, &mut out).expect("memory");
        let text = String::from_utf8(out).expect("text");
        let (line, counts) = text.split_once('\n').expect("two lines");
        assert!(
            line.ends_with("is in quarantine; remedy: `taceva plugin release org.example.x`"),
            "{line}"
        );
        assert_eq!(counts, "0 good, 0 absent, 1 problem\n");
    }
}
