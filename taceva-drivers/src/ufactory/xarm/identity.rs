//! Identity of an arm and its control box, from the answer to the version query.

use std::collections::BTreeMap;

use super::limits::ArmLimits;
use crate::text::shown;

/// Settings of an arm by name: serial numbers and firmware of its answer `version`, and its limits of speed.
pub(super) fn settings(version: &str, limits: Option<ArmLimits>) -> BTreeMap<String, String> {
    let parts: Vec<&str> = version.split(',').map(str::trim).collect();
    let mut settings = BTreeMap::new();
    let mut add = |name: &str, value: String| drop(settings.insert(name.to_owned(), value));
    // Axes, type, serial numbers of the arm and of the box, firmware.
    if let [_, _, arm, control_box, ..] = parts[..] {
        add("serial", shown(arm));
        add("control_box", shown(control_box));
    }
    if let Some(firmware) = parts.last() {
        add("firmware", shown(firmware));
    }
    if let Some(limits) = limits {
        let [least, most] = limits.speed_mm_s;
        add("speeds_mm_s", format!("{least} to {most}"));
    }
    settings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arm_is_known_by_its_serial_numbers_and_its_firmware() {
        let limits = ArmLimits {
            speed_mm_s: [0.1, 1_000.0],
            acceleration_mm_s2: [1.0, 50_000.0],
        };
        let found = settings("6,12,XF1300000001,AC1300000002,v2.7.0", Some(limits));
        for (name, expected) in [
            ("serial", "XF1300000001"),
            ("control_box", "AC1300000002"),
            ("firmware", "v2.7.0"),
            ("speeds_mm_s", "0.1 to 1000"),
        ] {
            assert_eq!(found[name], expected, "{name}");
        }
        let bare = settings("v1.6.9", None);
        assert_eq!(bare.len(), 1);
        assert_eq!(bare["firmware"], "v1.6.9");
    }
}
