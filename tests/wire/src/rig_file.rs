//! The rig file of a bench: which driver reaches which device, and how they stand to each other.

use std::fmt::Write as _;
use std::path::Path;

use crate::base::Base;
use crate::bench::WallBench;
use crate::error::WireError;
use crate::{control, mjpeg, sri, xarm};

/// What is to be written.
#[derive(Clone, Copy, Debug)]
pub struct RigFile<'a> {
    /// The gel.
    pub bench: &'a WallBench,
    /// The arm over it, if there is one.
    pub robot: Option<&'a xarm::Emulator>,
    /// The transducer, if there is one.
    pub force: Option<&'a sri::Emulator>,
    /// The camera, if there is one.
    pub camera: Option<&'a mjpeg::Emulator>,
    /// Whether the camera streams PNG.
    pub is_png: bool,
    /// Where faults are injected.
    pub control: &'a control::Control,
}

impl RigFile<'_> {
    /// The text of the file.
    pub fn text(&self) -> String {
        let mut text = format!(
            "# Everything here is simulated: {}. Faults and truth: JSON lines on {}.\nrig_version = 1\n",
            self.bench.serial(),
            self.control.address()
        );
        let axes = toml::Value::from(Base::AXES.to_vec());
        // A string takes whatever is written, so writing to it does not fail.
        let mut section = |name: &str, lines: &[String]| {
            let _ = write!(text, "\n[{name}]\n{}\n", lines.join("\n"));
        };
        if let Some(arm) = self.robot {
            let port = |port| arm.address(port).port();
            let driver = format!(
                "ufactory/xarm:host={};port={};pose_port={};status_port={}",
                arm.address(xarm::Port::Command).ip(),
                port(xarm::Port::Command),
                port(xarm::Port::Pose),
                port(xarm::Port::Status),
            );
            let origin = toml::Value::from(Base::ORIGIN_MM.to_vec());
            section(
                "robot",
                &[
                    format!("driver = {}", toml::Value::from(driver)),
                    "carries = \"indenter\"".to_owned(),
                    format!("origin_mm = {origin}"),
                    format!("axes = {axes}"),
                ],
            );
        }
        if let Some(force) = self.force {
            let address = force.address();
            let driver = format!("sri/m8128:host={};port={}", address.ip(), address.port());
            section(
                "force",
                &[
                    format!("driver = {}", toml::Value::from(driver)),
                    format!("axes = {axes}"),
                    "latency_ms = 0.0".to_owned(),
                ],
            );
        }
        if let Some(camera) = self.camera {
            let url = match self.is_png {
                true => camera.png_url(),
                false => camera.url(),
            };
            let driver = format!("camera/mjpeg:url={url}");
            section(
                "sensor",
                &[
                    format!("driver = {}", toml::Value::from(driver)),
                    "latency_ms = 0.0".to_owned(),
                ],
            );
        }
        section("limits", &["speed_max_mm_s = 20.0".to_owned()]);
        text
    }

    /// Writes the file.
    ///
    /// # Errors
    /// [`WireError::Write`].
    pub fn write(&self, path: &Path) -> Result<(), WireError> {
        std::fs::write(path, self.text()).map_err(|source| WireError::Write {
            path: path.to_owned(),
            source,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::net::Ipv4Addr;

    use super::*;
    use crate::options::BenchOptions;

    #[test]
    fn the_file_is_toml_that_names_every_device_and_says_that_it_is_simulated() {
        let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
        let arm = xarm::Emulator::start(&bench, xarm::Ports::ANY).expect("an arm");
        let force = sri::Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0).expect("a box");
        let camera = mjpeg::Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0, mjpeg::Style::Usual)
            .expect("a camera");
        let control =
            control::Control::start(&bench, None, Ipv4Addr::LOCALHOST, 0).expect("a port");
        let text = RigFile {
            bench: &bench,
            robot: Some(&arm),
            force: Some(&force),
            camera: Some(&camera),
            is_png: true,
            control: &control,
        }
        .text();
        assert!(text.starts_with("# Everything here is simulated: TACEVA-SIM0007."));
        let table: toml::Table = text.parse().expect("TOML");
        let driver = |section: &str| table[section]["driver"].as_str().expect("a selector");
        assert!(driver("robot").starts_with("ufactory/xarm:host=127.0.0.1;port="));
        assert!(driver("force").starts_with("sri/m8128:host=127.0.0.1;port="));
        assert!(driver("sensor").ends_with("/stream.png"));
        assert_eq!(table["robot"]["axes"][1].as_str(), Some("-y"));
        assert_eq!(table["robot"]["origin_mm"][2].as_float(), Some(251.3));
    }
}
