//! List of the serial ports of this machine, with names that stay the same after replugging.

use std::fs;
use std::path::Path;

use taceva_core::{DriverKey, Found};

use crate::present::access_of;
use crate::text::shown;

/// Lists every connected serial adapter as a device of `driver`. The firmware of the connected machine is unknown until the port is opened.
pub(super) fn adapters(driver: &DriverKey) -> Vec<Found> {
    adapters_in(Path::new("/"), driver)
}

fn adapters_in(root: &Path, driver: &DriverKey) -> Vec<Found> {
    let folder = root.join("dev/serial/by-id");
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        // A `;` would end the argument.
        .filter(|name| !name.contains(';'))
        .collect();
    names.sort();
    let found = names.into_iter().map(|name| {
        let path = format!("/dev/serial/by-id/{name}");
        Found::new(driver.clone(), format!("a serial port: {}", shown(&name)))
            .with_access(access_of(&root.join(&path[1..]), "dialout"))
            .with_arguments(format!("port={path}"))
    });
    found.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adapters_are_listed_by_their_lasting_names() {
        let driver = DriverKey::fixed("gcode/test");
        let root = tempfile::tempdir().expect("a folder");
        assert_eq!(adapters_in(root.path(), &driver), []);
        let folder = root.path().join("dev/serial/by-id");
        fs::create_dir_all(&folder).expect("a folder");
        for name in ["usb-b_2-if00", "usb-a_1-if00", "usb-c;x"] {
            fs::write(folder.join(name), "").expect("a file");
        }
        let found = adapters_in(root.path(), &driver);
        let arguments: Vec<&str> = found.iter().map(|found| found.arguments.as_str()).collect();
        assert_eq!(
            arguments,
            [
                "port=/dev/serial/by-id/usb-a_1-if00",
                "port=/dev/serial/by-id/usb-b_2-if00"
            ]
        );
    }
}
