//! Settings of the devices of a rig, with a prefix for each device, and warnings of the devices about their readings.

use std::collections::BTreeMap;
use std::sync::PoisonError;

use taceva_protocol::{RigFile, RigLimits};

use super::devices::{OpenRig, key_of};
use super::latency::written_latencies_ms;
use super::workshop::Workshop;
use crate::instruments;

impl OpenRig {
    /// Settings that the devices report. Names of the transducer's and the robot's settings begin with `force_` and `robot_`.
    pub(super) fn settings(&self) -> BTreeMap<String, String> {
        let sensor = self.sensor.as_ref();
        let mut settings = sensor.map(|sensor| sensor.settings()).unwrap_or_default();
        add_settings(&mut settings, "force", self.force.settings());
        add_settings(&mut settings, "robot", self.robot.settings());
        settings
    }

    /// Warnings to store in the recording: about readings of the devices, and about late halts.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut warnings = self.force.warnings();
        warnings.extend(self.robot.warnings());
        warnings.extend(self.late_halts.clone());
        warnings
    }

    /// Shows the operator, if any, the warnings of the devices and the contradictions of certificates. Messages in `shown` are omitted, and other
    /// messages are added to `shown`.
    pub(super) fn warn(&self, workshop: Workshop<'_>, shown: &mut Vec<String>) {
        let Some(operator) = workshop.operator else {
            return;
        };
        let mut operator = operator.lock().unwrap_or_else(PoisonError::into_inner);
        let rig = self.rig_file.as_deref();
        let instruments = rig.map(instruments::of_rig).unwrap_or_default();
        let mut warnings = self.warnings();
        warnings.extend(instruments::warnings_today(instruments, &self.settings()));
        for warning in warnings {
            if !shown.contains(&warning) {
                operator.warn(&warning);
                shown.push(warning);
            }
        }
    }
}

/// Setting `sensor_driver` with the key of the sensor's driver.
pub(crate) fn sensor_driver(key: &str) -> (String, String) {
    ("sensor_driver".to_owned(), key.to_owned())
}

/// Facts of a rig file as settings of a recording: laboratory and operator, mounting and latencies of devices, driver of the sensor, and digest of the
/// file.
pub(crate) fn of_rig_file(rig: &RigFile) -> BTreeMap<String, String> {
    let mut settings = BTreeMap::from([("rig_file".to_owned(), rig.digest().to_string())]);
    for (key, name) in [
        ("laboratory", &rig.laboratory),
        ("operator", &rig.operator_name),
    ] {
        settings.extend(name.clone().map(|name| (key.to_owned(), name)));
    }
    let axes = [
        ("robot_axes", rig.robot.as_ref().map(|robot| &robot.axes)),
        ("force_axes", rig.force.as_ref().map(|force| &force.axes)),
    ];
    for (name, axes) in axes {
        settings.extend(axes.map(|axes| (name.to_owned(), axes.value.to_string())));
    }
    let sensor = rig.sensor.as_ref();
    settings.extend(sensor.map(|sensor| sensor_driver(key_of(&sensor.driver.value))));
    let [robot_ms, force_ms, sensor_ms] = written_latencies_ms(rig);
    let force_u_ms = rig.force.as_ref().and_then(|force| force.latency_u_ms);
    let sensor_u_ms = rig.sensor.as_ref().and_then(|sensor| sensor.latency_u_ms);
    for (name, value_ms) in [
        ("robot_latency_ms", robot_ms),
        ("force_latency_ms", force_ms),
        ("force_latency_u_ms", force_u_ms.map(|stated| stated.value)),
        ("sensor_latency_ms", sensor_ms),
        (
            "sensor_latency_u_ms",
            sensor_u_ms.map(|stated| stated.value),
        ),
    ] {
        settings.extend(value_ms.map(|value_ms| (name.to_owned(), value_ms.to_string())));
    }
    settings
}

/// Limits of the motions on a rig as settings of a recording.
pub(crate) fn of_limits(limits: &RigLimits) -> BTreeMap<String, String> {
    let named = [
        ("robot_Pz_max_mm", limits.depth_max.0),
        ("robot_Fz_max_N", limits.normal_max.0),
        ("robot_Fxy_max_N", limits.shear_max.0),
        ("robot_speed_max_mm_s", limits.speed_max_mm_s),
    ];
    let named = named.into_iter();
    let settings = named.map(|(name, limit)| (name.to_owned(), limit.to_string()));
    settings.collect()
}

/// Adds the settings of a device to the settings of its rig, with names that begin with `kind`, such as `force_serial`.
pub(crate) fn add_settings(
    all: &mut BTreeMap<String, String>,
    kind: &str,
    settings: BTreeMap<String, String>,
) {
    let named = settings.into_iter();
    all.extend(named.map(|(name, value)| (format!("{kind}_{name}"), value)));
}

#[cfg(test)]
mod tests {
    use taceva_core::{Millimetre, Newton};

    use super::*;

    #[test]
    fn a_rig_file_states_axes_latencies_and_its_digest() {
        let text = "rig_version = 1\n[force]\ndriver = \"lab/box\"\naxes = [\"x\", \"-y\", \"-z\"]\nlatency_ms = 31.8\nlatency_u_ms = 0.3\n";
        let rig = RigFile::parse("lab.toml", text).expect("a rig");
        let settings = of_rig_file(&rig);
        assert_eq!(settings["force_axes"], "[\"x\", \"-y\", \"-z\"]");
        assert_eq!(settings["force_latency_ms"], "31.8");
        assert_eq!(settings["force_latency_u_ms"], "0.3");
        assert_eq!(settings["rig_file"], rig.digest().to_string());
        assert_eq!(settings.len(), 4, "{settings:?}");
        let camera = "[sensor]\ndriver = \"camera/mjpeg:url=http://10.0.0.9/\"\n";
        let rig = RigFile::parse("lab.toml", &format!("{text}{camera}")).expect("a rig");
        assert_eq!(of_rig_file(&rig)["sensor_driver"], "camera/mjpeg");
    }

    #[test]
    fn a_recording_keeps_the_laboratory_and_the_operator_of_its_rig_file() {
        let text =
            "rig_version = 1\nlaboratory = \"Soft Robotics\"\n[operator]\nname = \"A. Lovelace\"\n";
        let rig = RigFile::parse("lab.toml", text).expect("a rig");
        let settings = of_rig_file(&rig);
        assert_eq!(settings["laboratory"], "Soft Robotics");
        assert_eq!(settings["operator"], "A. Lovelace");
    }

    #[test]
    fn settings_of_a_transducer_stand_beside_those_of_a_camera() {
        let pair = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        let mut all = BTreeMap::from([pair("serial", "D20042")]);
        let force = BTreeMap::from([pair("serial", "FT12345"), pair("filter", "0")]);
        add_settings(&mut all, "force", force);
        let expected = [
            pair("force_filter", "0"),
            pair("force_serial", "FT12345"),
            pair("serial", "D20042"),
        ];
        assert_eq!(all, BTreeMap::from(expected));
    }

    #[test]
    fn the_limits_of_the_motions_are_settings_with_their_units() {
        let limits = RigLimits {
            depth_max: Millimetre(1.5),
            normal_max: Newton(5.0),
            shear_max: Newton(2.0),
            saturation: None,
            speed_max_mm_s: 20.0,
            overshoot: taceva_protocol::Overshoot {
                segment_mm: 0.015,
                healthy_mm: 0.0155,
                frozen_mm: 0.1205,
            },
            simulated: false,
            signals: taceva_protocol::Signals::default(),
        };
        let expected = [
            ("robot_Fxy_max_N", "2"),
            ("robot_Fz_max_N", "5"),
            ("robot_Pz_max_mm", "1.5"),
            ("robot_speed_max_mm_s", "20"),
        ];
        let expected = expected.map(|(name, value)| (name.to_owned(), value.to_owned()));
        assert_eq!(of_limits(&limits), BTreeMap::from(expected));
    }
}
