//! Benchmark of one 640×480×3 frame captured through a child process, compared with a copy of as many bytes: `cargo bench -p taceva-host --bench
//! child`. Set `TACEVA_PYTHON=/path/to/venv/bin/python` to include a Python child.

#[path = "../tests/support/built_in.rs"]
mod built_in;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use built_in::BuiltIn;
use divan::{Bencher, black_box};
use taceva_core::{
    ArgSpec, Args, Deadline, Descriptor, DescriptorSpec, DriverError, DriverKey, DriverSource,
    ErrorKind, Factory, Facts, FrameInfo, FrameMut, PixelFormat, Rig, Sensor, SensorFacts, Stamp,
};
use taceva_host::{
    ChildSession, ChildSpec, Children, PluginConfig, PluginHost, Plugins, SearchPath, Session,
    main_if_child_with,
};

fn main() -> ExitCode {
    main_if_child_with(|_| match served() {
        Ok(session) => Ok(Arc::new(session)),
        Err(error) => Err((ErrorKind::Internal, error.to_string())),
    });
    divan::main();
    ExitCode::SUCCESS
}

const KEY: DriverKey = DriverKey::fixed("bench/camera");
const FRAME: FrameInfo = FrameInfo {
    width: 640,
    height: 480,
    format: PixelFormat::Rgb8,
};
const BYTES: usize = 640 * 480 * 3;
const LONG: Deadline = Deadline::after(Duration::from_secs(10));

fn served() -> Result<BuiltIn, taceva_core::RegistryError> {
    let mut served = BuiltIn::new()?;
    let facts = SensorFacts::default().with_frame(FRAME);
    let facts = Facts::Sensor(Box::new(facts));
    let descriptor = DescriptorSpec::new(KEY, "a camera", DriverSource::Simulated, facts)
        .arguments(arguments())
        .check()?;
    served.sensors.add(Box::new(Cameras(descriptor)))?;
    Ok(served)
}

fn arguments() -> Vec<ArgSpec> {
    vec![ArgSpec::flag("writes")]
}

struct Cameras(Descriptor);

impl Factory<dyn Sensor> for Cameras {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        Ok(Box::new(Camera {
            picture: args.flag("writes").then(|| vec![7; BYTES]),
        }))
    }
}

/// Camera that copies one image into every frame, or leaves the frame unchanged to measure only the transport.
struct Camera {
    picture: Option<Vec<u8>>,
}

impl Sensor for Camera {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }

    fn capture(&mut self, mut into: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
        if let Some(picture) = &self.picture {
            into.bytes_mut().copy_from_slice(picture);
        }
        Ok(Stamp::at(Duration::from_secs(1)))
    }
}

fn capture_through_a_child(bencher: Bencher<'_, '_>, writes: &str) {
    let arguments = BTreeMap::from([(KEY, arguments())]);
    let args = Args::parse(&arguments[&KEY], writes).expect("sound");
    let spec = ChildSpec::new("bench", Vec::new());
    let session = ChildSession::start(spec, DriverKey::fixed("bench"), arguments).expect("a child");
    let mut camera = session.sensor(&KEY, &args).expect("a camera");
    let mut bytes = vec![0; BYTES];
    bencher.bench_local(|| {
        let into = FrameMut::new(FRAME, &mut bytes).expect("fits");
        camera.capture(into, LONG).expect("a frame")
    });
}

#[divan::bench]
fn copy(bencher: Bencher<'_, '_>) {
    let (from, mut into) = (vec![7_u8; BYTES], vec![0_u8; BYTES]);
    bencher.bench_local(|| black_box(&mut into).copy_from_slice(black_box(&from)));
}

#[divan::bench]
fn child(bencher: Bencher<'_, '_>) {
    capture_through_a_child(bencher, "writes=false");
}

#[divan::bench]
fn child_that_writes_each_frame(bencher: Bencher<'_, '_>) {
    capture_through_a_child(bencher, "writes=true");
}

/// Source of a Python plugin whose camera fills each frame.
const PACKAGE: &str = r#"
import numpy as np
import taceva.plugin as tp
class Camera(tp.Sensor, title="camera", source="simulated", frame=(640, 480, "rgb8")):
    def __init__(self):
        self.picture = np.full((480, 640, 3), 7, np.uint8)
    def capture(self, into, deadline):
        into[:] = self.picture
        return 1.0
plugin = tp.Plugin("org.example.bench", "1.0.0", {"camera": Camera})
"#;
const MANIFEST: &str = r#"
manifest_version = 1
id = "org.example.bench"
name = "bench"
version = "1.0.0"
license = "MIT"
program = { python = "lab_bench", wire = 2 }
[[provides]]
kind = "sensor"
key = "camera"
title = "camera"
source = "simulated"
frame = { width = 640, height = 480, format = "rgb8" }
"#;

/// Python interpreter that `TACEVA_PYTHON` names; its environment has the package `taceva`, and the user of a plugin may read it.
fn interpreter() -> Option<PathBuf> {
    std::env::var_os("TACEVA_PYTHON").map(PathBuf::from)
}

#[divan::bench(ignore = interpreter().is_none())]
fn child_in_python_that_writes_each_frame(bencher: Bencher<'_, '_>) {
    let folder = tempfile::tempdir().expect("a folder");
    let package = folder.path().join("lab_bench");
    std::fs::create_dir(&package).expect("room");
    std::fs::write(package.join("__init__.py"), PACKAGE).expect("room");
    std::fs::write(package.join("plugin.toml"), MANIFEST).expect("room");
    for path in [folder.path(), &package] {
        let everybody = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        std::fs::set_permissions(path, everybody).expect("ours");
    }
    let interpreters: Vec<PathBuf> = interpreter().into_iter().collect();
    let found = Plugins::search_with(SearchPath::empty().given([package]), &[], &interpreters);
    let host = PluginHost::with_children(
        found,
        PluginConfig::default(),
        Arc::new(|_, _, _, _| {}),
        Children::default(),
    );
    let drivers = host.drivers::<dyn Sensor>();
    let driver = drivers.first().expect("one");
    let mut camera = driver
        .open(&Args::default(), &mut Rig::new())
        .unwrap_or_else(|error| panic!("{error}"));
    let mut bytes = vec![0; BYTES];
    bencher.bench_local(|| {
        let into = FrameMut::new(FRAME, &mut bytes).expect("fits");
        camera.capture(into, LONG).expect("a frame")
    });
    assert!(bytes.iter().all(|byte| *byte == 7), "another picture");
}
