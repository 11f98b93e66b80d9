//! Rig file of a bench: the driver of each device, and the poses of the devices.

use std::fmt::Write as _;

use crate::base::Base;
use crate::bench::WallBench;
use crate::control::Control;

/// Content of the file: the drivers with their arguments.
#[derive(Clone, Debug)]
pub(crate) struct RigFile<'a> {
    pub(crate) bench: &'a WallBench,
    /// Selector of the arm over the gel.
    pub(crate) robot: String,
    /// Selector of the transducer.
    pub(crate) force: String,
    /// Selector of the camera.
    pub(crate) sensor: String,
    /// Control port.
    pub(crate) control: &'a Control,
}

impl RigFile<'_> {
    /// Text of the file.
    pub(crate) fn text(&self) -> String {
        let mut text = format!(
            "# Everything here is simulated: {}. Faults and truth: JSON lines on {}.\nrig_version = 1\nsimulated = true\n",
            self.bench.serial(),
            self.control.address()
        );
        let axes = toml::Value::from(Base::AXES.to_vec());
        let origin = toml::Value::from(Base::ORIGIN_MM.to_vec());
        let driver = |selector: &str| format!("driver = {}", toml::Value::from(selector));
        let latency = || "latency_ms = 0.0".to_owned();
        let robot = [
            driver(&self.robot),
            "carries = \"indenter\"".to_owned(),
            format!("origin_mm = {origin}"),
            format!("axes = {axes}"),
        ];
        let force = [driver(&self.force), format!("axes = {axes}"), latency()];
        let sensor = [driver(&self.sensor), latency()];
        let [depth_max_mm, force_max_n] = self.bench.limits();
        // Facts of the gel that a camera cannot report.
        let limits = [
            "speed_max_mm_s = 20.0".to_owned(),
            format!("Pz_max_mm = {depth_max_mm:?}"),
            format!("Fz_max_N = {force_max_n:?}"),
            // As on the bench simulated in the program, so that both make the same presses.
            format!("Fxy_max_N = {:?}", self.bench.force_range_n()),
        ];
        for (name, lines) in [
            ("robot", &robot[..]),
            ("force", &force),
            ("sensor", &sensor),
            ("limits", &limits),
        ] {
            // Writing to a string cannot fail.
            let _ = write!(text, "\n[{name}]\n{}\n", lines.join("\n"));
        }
        text
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
        let control = Control::start(&bench, None, Ipv4Addr::LOCALHOST, 0).expect("a port");
        let text = RigFile {
            bench: &bench,
            robot: "ufactory/xarm:host=127.0.0.1;port=502".to_owned(),
            force: "sri/m8128:host=127.0.0.1".to_owned(),
            sensor: "camera/mjpeg:url=http://127.0.0.1:80/\"x\"".to_owned(),
            control: &control,
        }
        .text();
        assert!(text.starts_with("# Everything here is simulated: TACEVA-SIM0007."));
        let table: toml::Table = text.parse().expect("TOML");
        let driver = |section: &str| table[section]["driver"].as_str().expect("a selector");
        assert_eq!(driver("robot"), "ufactory/xarm:host=127.0.0.1;port=502");
        assert_eq!(driver("force"), "sri/m8128:host=127.0.0.1");
        assert!(driver("sensor").ends_with("/\"x\""));
        assert_eq!(table["robot"]["axes"][1].as_str(), Some("-y"));
        assert_eq!(table["robot"]["origin_mm"][2].as_float(), Some(251.3));
        let shear_n = table["limits"]["Fxy_max_N"].as_float();
        assert_eq!(shear_n, Some(bench.force_range_n()));
        assert_eq!(table["limits"]["Pz_max_mm"].as_float(), Some(1.0));
    }
}
