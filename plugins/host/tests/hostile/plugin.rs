//! Builds a plugin that misbehaves and opens it in a child.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use taceva_core::{
    Args, Deadline, DriverError, DriverKey, FrameInfo, FrameMut, PixelFormat, Sensor,
};
use taceva_host::{
    ChildError, ChildSession, ChildSpec, Image, Manifest, Patience, Quarantine, Session, platform,
};
use tempfile::TempDir;

/// Sensor of the plugin.
pub(crate) const SENSOR: DriverKey = DriverKey::fixed("org.example.hostile/sensor");
/// Robot of the plugin.
pub(crate) const ROBOT: DriverKey = DriverKey::fixed("org.example.hostile/robot");
/// Force transducer of the plugin.
pub(crate) const FORCE: DriverKey = DriverKey::fixed("org.example.hostile/force");

/// Path of the program that runs as the child process.
pub(crate) const CHILD: &str = env!("CARGO_BIN_EXE_taceva-host-child");

const FRAME: FrameInfo = FrameInfo {
    width: 64,
    height: 48,
    format: PixelFormat::Rgb8,
};

const SENSOR_TABLE: &str = r#"kind = "sensor"
key = "sensor"
title = "a hostile sensor"
source = "real"
frame = { width = 64, height = 48, format = "rgb8" }
"#;
const ROBOT_TABLE: &str = r#"kind = "robot"
key = "robot"
title = "a hostile robot"
source = "real"
"#;
const FORCE_TABLE: &str = r#"kind = "force"
key = "force"
title = "a hostile transducer"
source = "real"
axes = ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"]
tare = true
"#;

/// Deadline for calls that do not hang.
pub(crate) const LONG: Deadline = Deadline::after(Duration::from_millis(200));

/// A built plugin: its library and manifest.
pub(crate) struct Plugin {
    folder: TempDir,
    manifest: Manifest,
    text: String,
}

impl Plugin {
    /// Builds a plugin with the misbehaviour `way` and the compiler options `defines`.
    pub(crate) fn build(way: &str, defines: &[String]) -> Plugin {
        let folder = tempfile::tempdir().expect("a folder");
        let mut header = String::new();
        for (name, table) in [
            ("SENSOR_TABLE", SENSOR_TABLE),
            ("ROBOT_TABLE", ROBOT_TABLE),
            ("FORCE_TABLE", FORCE_TABLE),
        ] {
            writeln!(header, "#define {name} {table:?}").expect("a string");
        }
        std::fs::write(folder.path().join("tables.h"), header).expect("written");
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let built = Command::new("cc")
            .args(["-std=c11", "-shared", "-fPIC", "-O0", "-w", "-pthread"])
            .arg("-I")
            .arg(here.join("../abi/include"))
            .arg("-I")
            .arg(folder.path())
            .arg(format!("-DWAY={way:?}"))
            .args(defines)
            .arg(here.join("tests/hostile/hostile.c"))
            .arg("-o")
            .arg(folder.path().join("libhostile.so"))
            .status()
            .expect("a compiler of C");
        assert!(built.success(), "the plugin `{way}` did not compile");
        let text = manifest();
        std::fs::write(folder.path().join("plugin.toml"), &text).expect("written");
        let manifest = Manifest::parse(&text).expect("sound");
        Plugin {
            folder,
            manifest,
            text,
        }
    }

    /// Folder of the plugin.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Path of its library.
    pub(crate) fn library(&self) -> PathBuf {
        self.folder.path().join("libhostile.so")
    }

    /// Reads the library in its current state.
    pub(crate) fn image(&self) -> Result<Image, taceva_host::LoadError> {
        let library = self.manifest.library(&platform()).expect("named");
        Image::read(self.folder.path(), library)
    }

    /// Starts a child that loads the library.
    pub(crate) fn start(
        &self,
        patience: Patience,
        quarantine: Option<Quarantine>,
    ) -> Result<ChildSession, ChildError> {
        self.start_image(&self.image().expect("a library"), patience, quarantine)
    }

    /// Starts a child that loads `image`.
    pub(crate) fn start_image(
        &self,
        image: &Image,
        patience: Patience,
        quarantine: Option<Quarantine>,
    ) -> Result<ChildSession, ChildError> {
        let spec = ChildSpec::of_plugin(image, &self.manifest, &self.text, quarantine);
        let mut spec = spec.expect("handed over");
        spec.program = Some(PathBuf::from(CHILD));
        spec.patience = patience;
        ChildSession::of_plugin(spec, &self.manifest)
    }
}

fn manifest() -> String {
    let platform = platform();
    format!(
        r#"manifest_version = 1
id = "org.example.hostile"
name = "hostile"
version = "1.0.0"
license = "MIT"
abi = {{ major = 1, minor = 0 }}

[library]
{platform} = {{ path = "libhostile.so" }}

[[provides]]
{SENSOR_TABLE}
[[provides]]
{ROBOT_TABLE}
[[provides]]
{FORCE_TABLE}"#
    )
}

/// Opens the sensor of `session` and starts it.
pub(crate) fn sensor(session: &dyn Session) -> Result<Box<dyn Sensor>, DriverError> {
    let mut sensor = session.sensor(&SENSOR, &Args::default())?;
    sensor.start(LONG)?;
    Ok(sensor)
}

/// Captures a frame.
pub(crate) fn capture(sensor: &mut dyn Sensor) -> Result<Vec<u8>, DriverError> {
    let mut bytes = vec![0; FRAME.byte_len().expect("small")];
    let into = FrameMut::new(FRAME, &mut bytes).expect("fits");
    sensor.capture(into, LONG)?;
    Ok(bytes)
}
