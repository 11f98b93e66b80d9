//! A new project builds without a network, its tests pass, and its driver keeps the contract of its kind.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use taceva_conformance::{self as conformance, Report, Trial};
use taceva_core::{
    Changer, Channel, Channels, Device, DriverKey, Factory, FeatureShape, Features,
    ForceTransducer, Lighting, Robot, Sensor, SilentProgress, Targets, TrainingSet,
};
use taceva_host::{FitRequest, PluginConfig, PluginDriver, PluginHost, Plugins, Saved, SearchPath};
use taceva_needs::{Need, skip};
use taceva_template::{File, Kind, Name, Sources, c_project, project};

fn named(kind: Kind) -> Name {
    format!("my-{kind}").parse().expect("a name")
}

/// Writes a project to the folder `name` below `folder`.
fn written(folder: &Path, name: &Name, files: Vec<File>) -> PathBuf {
    let root = folder.join(name.as_str());
    for file in files {
        let path = root.join(&file.path);
        fs::create_dir_all(path.parent().expect("below the folder")).expect("room");
        fs::write(path, file.text).expect("room");
    }
    root
}

/// Writes and builds a project of `kind` for this processor, without a network. All kinds share the build products of dependencies.
fn build(folder: &Path, kind: Kind) -> PathBuf {
    let name = named(kind);
    let root = written(folder, &name, project(kind, &name, Sources::Vendored));
    for command in ["build", "test"] {
        let done = Command::new(env!("CARGO"))
            .args([command, "--release", "--offline", "--quiet"])
            .current_dir(&root)
            .env("CARGO_TARGET_DIR", folder.join("target"))
            .env("CARGO_HOME", folder.join("home"))
            .env(
                "RUSTFLAGS",
                "-D warnings -C target-cpu=native -C opt-level=3",
            )
            .output()
            .expect("cargo runs, it runs this test");
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{kind}: {said}");
    }
    // Copies the library to the path in the manifest, because the target folder is elsewhere.
    let library = format!("target/release/lib{}.so", name.as_crate());
    fs::create_dir_all(root.join("target/release")).expect("room");
    fs::copy(folder.join(&library), root.join(&library)).expect("it was built");
    root
}

/// Writes and builds a project of `kind` in C. Prints the reason and returns `None` without a compiler of C or make.
fn build_c(folder: &Path, kind: Kind) -> Option<PathBuf> {
    for tool in ["cc", "make"] {
        if let Err(error) = Command::new(tool).arg("--version").output() {
            skip(Need::CCompiler, format!("`{tool}`: {error}"));
            return None;
        }
    }
    let name = named(kind);
    let root = written(folder, &name, c_project(kind, &name));
    let done = Command::new("make")
        .arg("CFLAGS=-O2 -Wall -Wextra -Wpedantic -Werror")
        .current_dir(&root)
        .output()
        .expect("it was asked for its version");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{kind}: {said}");
    Some(root)
}

/// Host of the plugin in `folder`, which is trusted to run in this process.
fn trusted(folder: &Path) -> Arc<PluginHost> {
    let plugins = Plugins::search(SearchPath::empty().given([folder.to_owned()]), &[]);
    assert_eq!(plugins.len(), 1, "{:?}", plugins.rejections);
    let config = PluginConfig {
        trusted_now: plugins.iter().map(|plugin| plugin.id().clone()).collect(),
        ..PluginConfig::default()
    };
    PluginHost::new(plugins, config, Arc::new(|_, _, _, _| ()))
}

/// Asserts that the only driver of kind `D` keeps its contract.
fn keeps<D>(host: &Arc<PluginHost>, suite: fn(&dyn Factory<D>, &Trial) -> Report)
where
    D: Device + ?Sized,
    PluginDriver: Factory<D>,
{
    let drivers = host.drivers::<D>();
    assert_eq!(drivers.len(), 1);
    let report = suite(&*drivers[0], &Trial::default());
    assert!(report.passed(), "{report}");
}

/// Asserts that the estimator learns, and predicts `expected` after its fit and after saving and loading.
fn learns(host: &Arc<PluginHost>, expected: f64) {
    let key = DriverKey::fixed("org.example.my-estimator/my-estimator");
    let (plugin, info) = host.estimators().next().expect("one");
    let session = host.session(plugin.id(), &key).expect("it loads");
    let channels = Channels::new([Channel::PX]).expect("one");
    let shape = FeatureShape::flat(1);
    let seen = Features::new(shape, vec![0.0, 1.0, 2.0, 10.0]).expect("four samples");
    let training = TrainingSet::new(&seen, Targets::new(&channels, &[1.0, 2.0, 3.0, 50.0]));
    let settings = taceva_core::Args::parse(&info.settings, "").expect("defaults");
    let request = FitRequest::new(&settings, &training, &SilentProgress);
    let fitted = session.fit(&key, &request).expect("it learns");
    let bytes = fitted.save().expect("it can be kept");
    let saved = Saved::new(&bytes, &channels, shape);
    let loaded = session.load(&key, &saved).expect("its own bytes");
    let asked = Features::new(shape, vec![0.9]).expect("one sample");
    for model in [fitted, loaded] {
        let mut into = [0.0];
        model.predict(&asked, &mut into).expect("it answers");
        assert!((into[0] - expected).abs() < 1e-12, "{into:?}");
    }
    for length in 0..bytes.len() {
        let saved = Saved::new(&bytes[..length], saved.channels, saved.shape);
        assert!(session.load(&key, &saved).is_err(), "{length}");
    }
}

/// Asserts that the plugin in `folder` keeps the contract of `kind`. An estimator predicts `expected`.
fn keeps_contract(folder: &Path, kind: Kind, expected: f64) {
    let host = trusted(folder);
    match kind {
        Kind::Sensor => keeps::<dyn Sensor>(&host, conformance::sensor),
        Kind::Robot => keeps::<dyn Robot>(&host, conformance::robot),
        Kind::Force => keeps::<dyn ForceTransducer>(&host, conformance::force),
        Kind::Lighting => keeps::<dyn Lighting>(&host, conformance::lighting),
        Kind::Changer => keeps::<dyn Changer>(&host, conformance::changer),
        Kind::Estimator => learns(&host, expected),
    }
}

#[test]
fn a_new_project_of_every_kind_builds_offline_without_a_warning_and_keeps_its_contract() {
    let folder = tempfile::tempdir().expect("a folder");
    for kind in Kind::ALL {
        // The mean label of the nearest samples.
        keeps_contract(&build(folder.path(), kind), kind, 2.0);
    }
}

#[test]
fn a_new_project_of_every_kind_in_c_builds_without_a_warning_and_keeps_its_contract() {
    let folder = tempfile::tempdir().expect("a folder");
    for kind in Kind::ALL {
        let Some(root) = build_c(folder.path(), kind) else {
            return;
        };
        // The mean of the labels.
        keeps_contract(&root, kind, 14.0);
    }
}
