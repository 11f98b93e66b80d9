//! Writes a rig file: devices by their drivers, axes and limits.

use std::net::Ipv4Addr;
use std::path::Path;

use taceva_core::{DriverKind, DriverSource};
use taceva_dataset::internal::quoted;
use taceva_drivers::{Devices, ListedDriver, devices};
use taceva_protocol::RigFile;

use super::{Context, Interview, Usage, finish, target};
use crate::args::InitTarget;

/// Answer for a rig without a robot, given instead of a driver.
const BY_HAND: &str = "none";

pub(super) fn write(
    args: &InitTarget,
    interview: &mut Interview,
    context: &Context,
) -> anyhow::Result<u8> {
    let path = target(args, "rig.toml")?;
    let listed = devices(&context.drivers(None)?);
    let robot = device(&listed, DriverKind::Robot, "robot", interview)?;
    if robot == BY_HAND {
        return write_by_hand(&path, &listed, interview);
    }
    let carries = interview.choose(
        "what does the robot carry",
        &["indenter", "sensor"],
        Some("indenter"),
    )?;
    let force = device(&listed, DriverKind::Force, "force transducer", interview)?;
    let sensor = device(
        &listed,
        DriverKind::Sensor,
        "camera of the sensor",
        interview,
    )?;
    let simulated = emulation(&[&robot, &force, &sensor], interview)?;
    interview.say("limits protect the gel: the robot halts when a limit is exceeded; `taceva catalogue show NAME` prints tested depths and forces of a sensor");
    let depth = interview.number("greatest depth, in mm", None, [0.01, 50.0])?;
    let normal = interview.number("greatest normal force, in N", None, [0.01, 1000.0])?;
    let shear_question = "greatest shear force, in N";
    let as_normal = normal.to_string();
    let shear = interview.number(shear_question, Some(&as_normal), [0.01, 1000.0])?;
    let speed = interview.number("greatest speed, in mm/s", Some("20"), [0.1, 500.0])?;
    let text = format!(
        "# The devices of one rig. taceva is not a safety function: emergency stop and guards must work without it (docs/rig.md).
rig_version = 1
{simulated}# laboratory = \"my laboratory\"    # reports and data sheets name it

[robot]
driver = {robot:?}
carries = {carries:?}
origin_mm = [0.0, 0.0, 0.0]      # `taceva rig teach` writes this: the tip at the middle of the untouched gel, in the base frame
axes = [\"x\", \"y\", \"z\"]           # and this: the base axis of the sensor's x, y and z

[force]
driver = {force:?}
axes = [\"x\", \"y\", \"z\"]           # the transducer axis of x, y and z; Fz above 0 presses into the gel

[sensor]
driver = {sensor:?}
# Facts of the gel that no camera states, here or in the scene:
# opaque = true
# markers = false
# footprint = {{ shape = \"disc\", radius_mm = 8.0 }}

[limits]
Pz_max_mm = {depth:?}
Fz_max_N = {normal:?}
Fxy_max_N = {shear:?}
speed_max_mm_s = {speed:?}

# The person at the rig, and an enabling switch that the person holds while the robot moves; `taceva devices` lists its arguments:
# [operator]
# name = \"my name\"
# enable = \"hid/pedal:usb=0c45:7403\"
"
    );
    RigFile::parse(&path.display().to_string(), &text)?;
    let rig = quoted(&path);
    finish(
        &path,
        &text,
        &[
            format!("taceva rig teach {rig}     jog the robot to three places: origin and axes"),
            format!(
                "taceva rig check {rig}     first raise the tip by a centimetre; checks rates, gaps, noise and one halt"
            ),
            format!("taceva init scene; taceva plan scene.toml --rig {rig}"),
        ],
    )
}

/// Writes the rig file of a hand that presses in place of a robot.
fn write_by_hand(path: &Path, listed: &Devices, interview: &mut Interview) -> anyhow::Result<u8> {
    let force = device(listed, DriverKind::Force, "force transducer", interview)?;
    let sensor = device(
        listed,
        DriverKind::Sensor,
        "camera of the sensor",
        interview,
    )?;
    let simulated = emulation(&[&force, &sensor], interview)?;
    let text = format!(
        "# The devices of presses by hand, without a robot (docs/capture.md).
rig_version = 1
{simulated}
[force]
driver = {force:?}
axes = [\"x\", \"y\", \"z\"]           # the transducer axis of x, y and z; a press straight down must raise Fz
# latency_ms = 4.0               # delay from a measurement to its stamp, if known

[sensor]
driver = {sensor:?}
# latency_ms = 38.0
"
    );
    RigFile::parse(&path.display().to_string(), &text)?;
    let rig = quoted(path);
    finish(
        path,
        &text,
        &[
            format!(
                "taceva preview --rig {rig}     press straight down: if Fz falls, change `axes` of [force]"
            ),
            format!("taceva capture presses --rig {rig} --for 5min"),
        ],
    )
}

/// Line of the rig file that states an emulation; empty for real devices. Asks if a device has an address of this machine. The question has no
/// default, because this line lets a robot move without a typed name.
fn emulation(selectors: &[&String], interview: &mut Interview) -> anyhow::Result<&'static str> {
    let mut selectors = selectors.iter();
    if !selectors.any(|selector| is_on_this_machine(selector)) {
        return Ok("");
    }
    let question = "an address is on this machine: are the devices emulated, as by taceva-wire, so that nothing is measured";
    let answer = interview.choose(question, &["yes", "no"], None)?;
    Ok(match answer.as_str() {
        "yes" => {
            "simulated = true                 # nothing is measured: recordings and reports state this\n"
        }
        _ => "",
    })
}

/// True if an argument of the device is an address of this machine, such as `host=127.0.0.1` or `url=http://localhost:8080/`, or a pseudo-terminal.
fn is_on_this_machine(selector: &str) -> bool {
    let (_, arguments) = selector.split_once(':').unwrap_or_default();
    let values = arguments.split(';').filter_map(|one| one.split_once('='));
    let mut values = values.map(|(_, value)| value);
    values.any(|value| {
        let address = value.split_once("://").map_or(value, |(_, rest)| rest);
        let host = address.split(['/', ':']).next().unwrap_or_default();
        host == "localhost"
            || host
                .parse::<Ipv4Addr>()
                .is_ok_and(|address| address.is_loopback())
            || address.starts_with("[::1]")
            || value.starts_with("/dev/pts/")
    })
}

/// Asks for a device and returns its selector: the driver and its required arguments; for a robot also [`BY_HAND`].
fn device(
    listed: &Devices,
    kind: DriverKind,
    what: &str,
    interview: &mut Interview,
) -> anyhow::Result<String> {
    let of_kind: Vec<&ListedDriver> = listed
        .drivers
        .iter()
        .filter(|driver| driver.kind == kind && driver.source == DriverSource::Real)
        .collect();
    let keys: Vec<&str> = of_kind.iter().map(|driver| driver.key.as_str()).collect();
    let is_of_kind =
        |selector: &str| keys.contains(&selector.split(':').next().unwrap_or(selector));
    let present: Vec<&str> = listed
        .found
        .iter()
        .map(|found| found.selector.as_str())
        .filter(|selector| is_of_kind(selector))
        .collect();
    for driver in &of_kind {
        interview.say(&format!("  {:<18} {}", driver.key, driver.title));
    }
    for selector in &present {
        interview.say(&format!("  present: {selector}"));
    }
    let by_hand = match kind {
        DriverKind::Robot => ", or `none` if a hand presses",
        _ => "",
    };
    let is_by_hand = |answer: &str| kind == DriverKind::Robot && answer == BY_HAND;
    let known = format!("{}{by_hand}", keys.join(", "));
    let check = |answer: &str| match is_of_kind(answer) || is_by_hand(answer) {
        true => Ok(()),
        false => Err(format!("expected one of {known}")),
    };
    let answer = interview.ask(
        &format!(
            "driver of the {what}, alone or with arguments such as KEY:host=…;port=… ({known})"
        ),
        present.first().copied(),
        check,
    )?;
    if answer.contains(':') || is_by_hand(&answer) {
        return Ok(answer);
    }
    let driver = of_kind.into_iter().find(|driver| driver.key == answer);
    let driver = driver.ok_or_else(|| Usage::error(format!("{answer} is not a {what}")))?;
    let mut arguments = Vec::new();
    for argument in driver.arguments.iter().filter(|argument| argument.required) {
        let question = format!("{}: {} ({})", argument.key, argument.help, argument.takes);
        let is_one_word = |answer: &str| match answer.contains([';', '"', '\n']) {
            true => Err("without ; or quotation marks".to_owned()),
            false => Ok(()),
        };
        let value = interview.ask(&question, None, is_one_word)?;
        arguments.push(format!("{}={value}", argument.key));
    }
    Ok(match arguments.is_empty() {
        true => answer,
        false => format!("{answer}:{}", arguments.join(";")),
    })
}

#[cfg(test)]
mod tests {
    use super::is_on_this_machine;

    #[test]
    fn loopback_addresses_and_pseudo_terminals_are_on_this_machine_and_no_others() {
        for here in [
            "ufactory/xarm:host=127.0.0.1;port=40001",
            "sri/m8128:port=4008;host=localhost",
            "camera/mjpeg:url=http://127.0.0.1:8080/?action=stream",
            "camera/mjpeg:url=http://[::1]:8080/",
            "gcode/grbl:port=/dev/pts/3",
        ] {
            assert!(is_on_this_machine(here), "{here}");
        }
        for elsewhere in [
            "ufactory/xarm:host=192.168.1.200",
            "camera/mjpeg:url=http://127.example.org/",
            "camera/v4l2:device=/dev/video0",
            "gcode/grbl:port=/dev/ttyUSB0",
            "sri/m8128",
        ] {
            assert!(!is_on_this_machine(elsewhere), "{elsewhere}");
        }
    }
}
