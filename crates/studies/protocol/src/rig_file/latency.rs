//! Measured latencies of the devices of a rig, and their entries in the rig file.

use super::RigFile;
use crate::text::Setting;

/// Key of the latency of a device in its table.
pub(super) const LATENCY: &str = "latency_ms";
/// Key of the standard uncertainty of a latency.
pub(super) const UNCERTAINTY: &str = "latency_u_ms";

/// Delay of a device relative to the robot, measured by taps.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Latency {
    /// Delay that remains after the present latencies are applied, in ms; negative if the robot reports later.
    pub after_robot_ms: f64,
    /// Two standard errors of the delay, in ms.
    pub error_ms: f64,
    /// Two standard deviations of the delay of a single tap, in ms.
    pub spread_ms: f64,
}

/// Latencies of the devices of a rig, in ms, rounded to 0.1 ms. A latency is the delay between an observation and its time stamp.
///
/// ```
/// use taceva_protocol::{RigFile, RigLatencies};
/// let text = "rig_version = 1\n[force]\ndriver = \"lab/box\" # on the table\naxes = [\"x\", \"y\", \"z\"]\n";
/// let rig = RigFile::parse("lab.toml", text)?;
/// let latencies = RigLatencies { robot_ms: None, force_ms: 4.5, force_u_ms: 0.2, sensor_ms: 38.0, sensor_u_ms: 0.4 };
/// // A rig without a sensor has nowhere to write its latency.
/// assert_eq!(rig.with_latencies(&latencies), None);
/// # Ok::<(), taceva_protocol::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct RigLatencies {
    /// Latency of the robot; `None` leaves this latency unchanged.
    pub robot_ms: Option<f64>,
    /// Latency of the transducer.
    pub force_ms: f64,
    /// Standard uncertainty of the latency of the transducer relative to the robot.
    pub force_u_ms: f64,
    /// Latency of the sensor.
    pub sensor_ms: f64,
    /// Standard uncertainty of the latency of the sensor relative to the robot.
    pub sensor_u_ms: f64,
}

impl RigLatencies {
    /// Computes the latencies from taps. `before` has the latencies of robot, transducer and sensor in use during the taps. `force` and `sensor` are
    /// the remaining delays relative to the robot.
    ///
    /// Taps measure only differences, so the latency of the robot normally stays. If another latency is below 0 by more than its error, all three
    /// increase until the least is 0.
    pub fn measured(before: [f64; 3], force: &Latency, sensor: &Latency) -> RigLatencies {
        let [robot_ms, force_ms, sensor_ms] = before;
        let force_ms = force_ms + force.after_robot_ms;
        let sensor_ms = sensor_ms + sensor.after_robot_ms;
        let is_early = force_ms < -force.error_ms || sensor_ms < -sensor.error_ms;
        let shift_ms = match is_early {
            true => -force_ms.min(sensor_ms),
            false => 0.0,
        };
        // Rounded for readers of the file; no latency is known to better than 0.1 ms.
        let tenths = |latency_ms: f64| ((latency_ms + shift_ms).max(0.0) * 10.0).round() / 10.0;
        RigLatencies {
            robot_ms: is_early.then(|| tenths(robot_ms)),
            force_ms: tenths(force_ms),
            force_u_ms: force.standard_ms(),
            sensor_ms: tenths(sensor_ms),
            sensor_u_ms: sensor.standard_ms(),
        }
    }
}

impl Latency {
    /// Standard uncertainty of the latency, with that of rounding to 0.1 ms. In ms, rounded up to 0.01 ms.
    fn standard_ms(&self) -> f64 {
        let rounding_ms = 0.1 / 12.0_f64.sqrt();
        (100.0 * (0.5 * self.error_ms).hypot(rounding_ms)).ceil() / 100.0
    }
}

/// Latency or uncertainty to write in the table of a device.
struct Entry<'a> {
    key: &'static str,
    driver: &'a Setting<String>,
    before: Option<Setting<f64>>,
    value_ms: f64,
}

impl Entry<'_> {
    /// Byte offset of the number, or of the driver if the table lacks the number.
    fn at(&self) -> Option<usize> {
        let number = self.before.as_ref().and_then(Setting::at);
        number.or_else(|| self.driver.at())
    }
}

impl RigFile {
    /// Text of the file with `latencies` written into it. `None` if a device is missing, or if its table takes no line after `driver`.
    pub fn with_latencies(&self, latencies: &RigLatencies) -> Option<String> {
        let (force, sensor) = (self.force.as_ref()?, self.sensor.as_ref()?);
        let entry = |key, driver, before, value_ms| Entry {
            key,
            driver,
            before,
            value_ms,
        };
        // If two lines follow one driver, the second line is inserted first.
        let (of_force, of_sensor) = (&force.driver, &sensor.driver);
        let mut written = vec![
            entry(
                UNCERTAINTY,
                of_force,
                force.latency_u_ms,
                latencies.force_u_ms,
            ),
            entry(LATENCY, of_force, force.latency_ms, latencies.force_ms),
            entry(
                UNCERTAINTY,
                of_sensor,
                sensor.latency_u_ms,
                latencies.sensor_u_ms,
            ),
            entry(LATENCY, of_sensor, sensor.latency_ms, latencies.sensor_ms),
        ];
        if let Some(robot_ms) = latencies.robot_ms {
            let robot = self.robot.as_ref()?;
            written.push(entry(LATENCY, &robot.driver, robot.latency_ms, robot_ms));
        }
        let mut text = self.text.whole().to_owned();
        // Edits the last position first, so that earlier byte offsets stay valid.
        written.sort_by_key(|entry| std::cmp::Reverse(entry.at()));
        for entry in &written {
            put(&mut text, entry)?;
        }
        // An inline table or dotted keys cannot take a line after the driver.
        let read = RigFile::parse(self.name(), &text).ok()?;
        let latency = |setting: Option<Setting<f64>>| setting.map(|setting| setting.value);
        let expected = RigFile {
            text: read.text.clone(),
            ..self.clone()
        };
        let expected = expected.with_values(latencies);
        let is_as_meant = read == expected
            && read
                .force
                .as_ref()
                .and_then(|force| latency(force.latency_ms))
                == Some(latencies.force_ms);
        is_as_meant.then_some(text)
    }

    fn with_values(mut self, latencies: &RigLatencies) -> RigFile {
        let set = |latency: &mut Option<Setting<f64>>, latency_ms: f64| {
            *latency = Some(Setting::default_of(latency_ms));
        };
        if let Some(force) = &mut self.force {
            set(&mut force.latency_ms, latencies.force_ms);
            set(&mut force.latency_u_ms, latencies.force_u_ms);
        }
        if let Some(sensor) = &mut self.sensor {
            set(&mut sensor.latency_ms, latencies.sensor_ms);
            set(&mut sensor.latency_u_ms, latencies.sensor_u_ms);
        }
        if let (Some(robot), Some(robot_ms)) = (&mut self.robot, latencies.robot_ms) {
            set(&mut robot.latency_ms, robot_ms);
        }
        self
    }
}

/// Replaces the number of `entry` in `text`, or inserts it in a line after the driver; `None` if the text has no such position.
fn put(text: &mut String, entry: &Entry<'_>) -> Option<()> {
    let Entry {
        key,
        driver,
        before,
        value_ms,
    } = entry;
    if let Some(at) = before.as_ref().and_then(Setting::at) {
        let is_of_number = |letter: char| letter.is_ascii_alphanumeric() || "+-._".contains(letter);
        let number = text.get(at..)?;
        let length = number.find(|letter| !is_of_number(letter));
        let end = at + length.unwrap_or(number.len());
        text.replace_range(at..end, &format!("{value_ms:?}"));
        return Some(());
    }
    insert_after(text, driver.at()?, &format!("{key} = {value_ms:?}"))
}

/// Inserts `line` after the line that contains the byte offset `from`; `None` if the text has no such offset.
pub(super) fn insert_after(text: &mut String, from: usize, line: &str) -> Option<()> {
    let end = text
        .get(from..)?
        .find('\n')
        .map_or(text.len(), |end| from + end);
    // Keeps the line endings of the file, `\n` or `\r\n`.
    let ending = match text.get(..end)?.ends_with('\r') {
        true => "\r\n",
        false => "\n",
    };
    let line = match end == text.len() {
        true => format!("{ending}{line}"),
        false => format!("{line}{ending}"),
    };
    text.insert_str((end + 1).min(text.len()), &line);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "rig_version = 1\n# Ours.\n[robot]\ndriver = \"lab/arm\" # the old one\ncarries = \"indenter\"\norigin_mm = [0.0, 0.0, 0.0]\naxes = [\"x\", \"y\", \"z\"]\n[force]\ndriver = \"lab/box:x=1\"\naxes = [\"x\", \"y\", \"z\"]\nlatency_ms = 4.0# box\n[sensor]\ndriver = \"lab/camera\"";
    const MEASURED: RigLatencies = RigLatencies {
        robot_ms: Some(6.5),
        force_ms: 0.0,
        force_u_ms: 0.25,
        sensor_ms: 38.2,
        sensor_u_ms: 0.4,
    };

    fn late(after_robot_ms: f64) -> Latency {
        Latency {
            after_robot_ms,
            error_ms: 0.5,
            spread_ms: 1.0,
        }
    }

    fn with(text: &str, latencies: &RigLatencies) -> Option<String> {
        let rig = RigFile::parse("lab.toml", text).expect("a rig");
        rig.with_latencies(latencies)
    }

    #[test]
    fn latencies_stand_in_their_tables_and_everything_else_stays_as_it_is_written() {
        let expected = TEXT
            .replace("# the old one\n", "# the old one\nlatency_ms = 6.5\n")
            .replace("4.0# box", "0.0# box")
            .replace("x=1\"\n", "x=1\"\nlatency_u_ms = 0.25\n")
            + "\nlatency_ms = 38.2\nlatency_u_ms = 0.4";
        let written = with(TEXT, &MEASURED).expect("three tables");
        assert_eq!(written, expected);
        // A second call changes nothing, and a robot without a new latency is left unchanged.
        assert_eq!(with(&written, &MEASURED), Some(written.clone()));
        let kept = RigLatencies {
            robot_ms: None,
            ..MEASURED
        };
        assert!(!with(TEXT, &kept).expect("two tables").contains("6.5"));
        let windows = TEXT.replace('\n', "\r\n");
        let written = with(&windows, &MEASURED).expect("three tables");
        assert!(
            written.contains("# the old one\r\nlatency_ms = 6.5\r\n"),
            "{written:?}"
        );
    }

    #[test]
    fn tables_that_take_no_line_behind_their_driver_are_left_alone() {
        let inline = TEXT.replace(
            "[sensor]\ndriver = \"lab/camera\"",
            "sensor = { driver = \"lab/camera\" }",
        );
        let inline = inline.replace("rig_version = 1\n", "rig_version = 1\n#\n");
        // In TOML, the line would belong to [force] there.
        let moved = inline.replace("sensor = { driver = \"lab/camera\" }", "");
        let moved = moved.replace("#\n", "sensor = { driver = \"lab/camera\" }\n");
        assert_eq!(with(&moved, &MEASURED), None);
        let alone = TEXT.split("[sensor]").next().expect("text before it");
        assert_eq!(with(alone, &MEASURED), None);
    }

    #[test]
    fn the_earliest_device_has_no_latency_and_noise_makes_none() {
        let [force, sensor] = [late(4.04), late(33.0)];
        let measured = RigLatencies::measured([0.0, 0.0, 5.0], &force, &sensor);
        assert_eq!((measured.robot_ms, measured.force_ms), (None, 4.0));
        // Half of the stated error, and the rounding to 0.1 ms.
        assert!((measured.force_u_ms - 0.26).abs() < 1e-9, "{measured:?}");
        assert!((measured.sensor_ms - 38.0).abs() < 1e-9);
        // Below 0 by less than the error.
        let measured = RigLatencies::measured([2.0, 0.0, 0.0], &late(-0.3), &sensor);
        assert_eq!((measured.robot_ms, measured.force_ms), (None, 0.0));
        // The robot reports later than the transducer.
        let measured = RigLatencies::measured([2.0, 0.0, 0.0], &late(-6.0), &sensor);
        assert_eq!((measured.robot_ms, measured.force_ms), (Some(8.0), 0.0));
        assert!((measured.sensor_ms - 39.0).abs() < 1e-9);
    }
}
