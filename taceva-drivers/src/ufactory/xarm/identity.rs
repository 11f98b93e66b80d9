//! Identity of an arm and its control box, from the answer to the version query.

use std::collections::BTreeMap;

use crate::text::shown;

/// Serial numbers and firmware of an arm, by setting name, from `version`, its answer to the version query.
pub(super) fn settings(version: &str) -> BTreeMap<String, String> {
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
    settings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arm_is_known_by_its_serial_numbers_and_its_firmware() {
        let found = settings("6,12,XF1300000001,AC1300000002,v2.7.0");
        for (name, expected) in [
            ("serial", "XF1300000001"),
            ("control_box", "AC1300000002"),
            ("firmware", "v2.7.0"),
        ] {
            assert_eq!(found[name], expected, "{name}");
        }
        let bare = settings("v1.6.9");
        assert_eq!(bare.len(), 1);
        assert_eq!(bare["firmware"], "v1.6.9");
    }
}
