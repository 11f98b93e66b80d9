//! The plugin `../fixture/plugin.c`, built with macros that each add one defect.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex};

use taceva_core::DriverKey;
use taceva_host::{
    Children, Image, InProcess, Level, Library, LibraryFile, LoadError, Offer, Place, Plugin,
    PluginConfig, PluginHost, Plugins, SearchPath,
};
use taceva_needs::{Need, skip};
use tempfile::TempDir;

pub(crate) const EYE: DriverKey = DriverKey::fixed("org.example.fixture/eye");
pub(crate) const ARM: DriverKey = DriverKey::fixed("org.example.fixture/arm");
pub(crate) const WRIST: DriverKey = DriverKey::fixed("org.example.fixture/wrist");
pub(crate) const LAMP: DriverKey = DriverKey::fixed("org.example.fixture/lamp");
pub(crate) const MEAN: DriverKey = DriverKey::fixed("org.example.fixture/mean");

pub(crate) const MANIFEST: &str = r#"
manifest_version = 1
id = "org.example.fixture"
name = "one of each"
version = "1.0.0"
license = "MIT"
abi = { major = 1, minor = 0 }
library.linux-x86_64 = { path = "libfixture.so" }
library.linux-aarch64 = { path = "libfixture.so" }

[[provides]]
kind = "sensor"
key = "eye"
title = "an eye, by the manifest: words may differ"
source = "simulated"
rate_hz = 1000
frame = { width = 8, height = 6, format = "rgb8" }
scenes = ["dark", "room"]

[[provides.args]]
key = "level"
type = "whole"
range = [0, 255]
default = 7
help = "of every pixel"

[[provides]]
kind = "robot"
key = "arm"
title = "arm"
source = "simulated"
guarded_motion = true
workspace = { least_mm = [-10, -10, -10], greatest_mm = [10, 10, 10] }
limits = { speed_max_mm_s = 100 }

[[provides]]
kind = "force"
key = "wrist"
title = "wrist"
source = "simulated"
axes = ["Fz"]
tare = true

[[provides]]
kind = "lighting"
key = "lamp"
title = "lamp"
source = "simulated"
scenes = ["dark", "room"]

[[provides]]
kind = "estimator"
key = "mean"
title = "mean"
"#;

/// Builds the plugin `../cpp/NAME.cpp` in a folder, with the manifest from its library; `None` without a C++ compiler.
pub(crate) fn cpp(name: &str, children: &Children) -> Option<TempDir> {
    let folder = tempfile::tempdir().expect("a folder");
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "c++".to_owned());
    let built = Command::new(&compiler)
        .args([
            "-std=c++17",
            "-O1",
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Werror",
        ])
        .args(["-shared", "-fPIC", "-fvisibility=hidden", "-pthread", "-I"])
        .arg(here.join("../abi/include"))
        .arg(here.join(format!("../host/tests/cpp/{name}.cpp")))
        .arg("-o")
        .arg(folder.path().join(format!("lib{name}.so")))
        .output();
    match built {
        Ok(done) => assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        ),
        Err(error) => {
            skip(Need::CppCompiler, format!("`{compiler}`: {error}"));
            return None;
        }
    }
    let library = LibraryFile {
        path: format!("lib{name}.so"),
        sha256: None,
    };
    let image = Image::read(folder.path(), &library).expect("a library");
    let offer = Offer::of(&image, children).unwrap_or_else(|error| panic!("{error}"));
    let manifest = offer
        .manifest("", &library, Some("MIT"))
        .expect("a manifest");
    fs::write(folder.path().join("plugin.toml"), manifest).expect("written");
    Some(folder)
}

/// Folder with the built test plugin.
pub(crate) struct Fixture {
    folder: TempDir,
}

impl Fixture {
    /// Builds the plugin with `macros`. Prints a note and returns `None` without a C compiler.
    pub(crate) fn built(macros: &[&str]) -> Option<Fixture> {
        let folder = tempfile::tempdir().expect("a folder");
        let plugins = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut compile = Command::new("cc");
        compile
            .args(["-std=c11", "-shared", "-fPIC", "-fvisibility=hidden", "-I"])
            .arg(plugins.join("../abi/include"))
            .args(macros.iter().map(|macro_| format!("-D{macro_}")))
            .arg(plugins.join("../host/tests/fixture/plugin.c"))
            .arg("-o")
            .arg(folder.path().join("libfixture.so"))
            .arg("-lm");
        match compile.output() {
            Ok(done) => assert!(
                done.status.success(),
                "{}",
                String::from_utf8_lossy(&done.stderr)
            ),
            Err(error) => {
                skip(Need::CCompiler, format!("`cc`: {error}"));
                return None;
            }
        }
        let fixture = Fixture { folder };
        fixture.write_manifest(MANIFEST);
        Some(fixture)
    }

    /// Links the plugin with a second library in the same folder, found by `$ORIGIN`.
    pub(crate) fn with_neighbour(self) -> Fixture {
        let folder = self.folder.path();
        let plugins = Path::new(env!("CARGO_MANIFEST_DIR"));
        fs::write(
            folder.join("neighbour.c"),
            "int neighbour(void) { return 1; }\n",
        )
        .expect("room");
        let cc = |arguments: &[&str], source: &Path, library: &str| {
            let done = Command::new("cc")
                .args(["-shared", "-fPIC", "-I"])
                .arg(plugins.join("../abi/include"))
                .arg(source)
                .arg("-o")
                .arg(folder.join(library))
                .arg("-L")
                .arg(folder)
                .args(arguments)
                .status();
            assert!(done.expect("it compiled before").success());
        };
        cc(&[], &folder.join("neighbour.c"), "libneighbour.so");
        let beside = ["-Wl,--no-as-needed,-rpath,$ORIGIN", "-lneighbour", "-lm"];
        cc(
            &beside,
            &plugins.join("../host/tests/fixture/plugin.c"),
            "libfixture.so",
        );
        self
    }

    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn library(&self) -> PathBuf {
        self.folder.path().join("libfixture.so")
    }

    /// Writes the manifest with `old` replaced by `new`.
    pub(crate) fn with_manifest(self, old: &str, new: &str) -> Fixture {
        assert!(MANIFEST.contains(old), "{old}");
        self.write_manifest(&MANIFEST.replacen(old, new, 1));
        self
    }

    fn write_manifest(&self, text: &str) {
        let path = self.folder.path().join("plugin.toml");
        fs::write(path, text).expect("writable");
    }

    pub(crate) fn found(&self) -> Plugins {
        let path = SearchPath::empty().given([self.folder.path().to_owned()]);
        Plugins::search(path, &[])
    }

    pub(crate) fn plugin(&self) -> Plugin {
        let plugins = self.found();
        let plugin = plugins.get("org.example.fixture");
        plugin.unwrap_or_else(|error| panic!("{error}")).clone()
    }

    pub(crate) fn loaded(&self) -> Result<Arc<Library>, LoadError> {
        let plugin = self.plugin();
        assert_eq!(plugin.place, Place::Given);
        let image = Image::read(&plugin.folder, plugin.library().expect("a library"))?;
        Library::load(&image, &plugin.manifest, Box::new(|_, _, _| {}))
    }

    pub(crate) fn session(&self) -> InProcess {
        let library = self.loaded().unwrap_or_else(|error| panic!("{error}"));
        InProcess::open(&library).expect("it has no rig")
    }

    /// Creates a host that trusts the plugin; also returns its log lines.
    pub(crate) fn trusted(&self) -> (Arc<PluginHost>, Arc<Mutex<Vec<String>>>) {
        let mut config = PluginConfig::default();
        config.trusted_now.insert(self.plugin().manifest.id);
        let lines = Arc::new(Mutex::new(Vec::new()));
        let log = Arc::clone(&lines);
        let host = PluginHost::new(
            self.found(),
            config,
            Arc::new(move |id, level: Level, target, message| {
                let line = format!("{id} {level:?} {target}: {message}");
                log.lock().expect("nobody panics").push(line);
            }),
        );
        (host, lines)
    }
}
