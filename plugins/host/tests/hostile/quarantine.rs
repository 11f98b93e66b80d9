//! The loaded library is the hashed one. A crashed library loads again only after the user releases it.

use std::sync::Arc;

use taceva_core::{Args, ErrorKind, Rig, Sensor};
use taceva_host::{
    ChildError, Children, Patience, PluginConfig, PluginHost, Plugins, Quarantine, SearchPath,
    libraries_loaded,
};

use crate::plugin::{CHILD, LONG, Plugin, capture, sensor};

#[test]
fn a_plugin_that_crashed_is_in_quarantine_until_it_is_released_or_built_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let quarantine = Quarantine::of_folder(folder.path().join("quarantine"));
    let start = |plugin: &Plugin| plugin.start(Patience::default(), Some(quarantine.clone()));
    let plugin = Plugin::build("capture_segv", &[]);
    for _ in 0..2 {
        let session = start(&plugin).expect("a child");
        let mut sensor = sensor(&session).expect("a sensor");
        capture(&mut *sensor).expect_err("it crashes");
        drop((sensor, session));
        let error = start(&plugin).expect_err("in quarantine");
        assert_eq!(error.kind(), ErrorKind::PermissionDenied);
        assert!(matches!(error, ChildError::Quarantined { .. }), "{error}");
        assert!(error.to_string().contains("signal 11"), "{error}");
        let released = quarantine.release("org.example.hostile");
        assert_eq!(released.expect("released"), 1);
    }
    let another = Plugin::build("good", &[]);
    drop(start(&another).expect("another library"));
    assert_eq!(quarantine.entries().expect("readable"), []);
}

#[test]
fn a_plugin_that_only_refuses_or_ends_as_asked_is_not_in_quarantine() {
    let folder = tempfile::tempdir().expect("a folder");
    let quarantine = Quarantine::of_folder(folder.path());
    for way in ["init_fails", "good", "status_unknown"] {
        let plugin = Plugin::build(way, &[]);
        if let Ok(session) = plugin.start(Patience::default(), Some(quarantine.clone())) {
            let mut sensor = sensor(&session).expect("a sensor");
            let _ = capture(&mut *sensor);
        }
        assert_eq!(quarantine.entries().expect("readable"), [], "{way}");
    }
}

#[test]
fn a_file_that_is_swapped_after_it_was_hashed_is_not_what_runs() {
    let (plugin, bad) = (
        Plugin::build("good", &[]),
        Plugin::build("capture_segv", &[]),
    );
    let image = plugin.image().expect("a library");
    std::fs::copy(bad.library(), plugin.library()).expect("written over");
    let session = plugin.start_image(&image, Patience::default(), None);
    let session = session.expect("a child");
    capture(&mut *sensor(&session).expect("a sensor")).expect("the library that was hashed");
    assert_ne!(plugin.image().expect("a library").digest(), image.digest());
}

#[test]
fn a_plugin_that_nobody_trusts_is_opened_in_a_child_and_never_here() {
    let plugin = Plugin::build("capture_segv", &[]);
    let path = SearchPath::empty().given([plugin.folder().to_owned()]);
    let folder = tempfile::tempdir().expect("a folder");
    let children = Children {
        program: Some(CHILD.into()),
        quarantine: Some(Quarantine::of_folder(folder.path())),
    };
    let host = PluginHost::with_children(
        Plugins::search(path, &[]),
        PluginConfig::default(),
        Arc::new(|_, _, _, _| {}),
        children,
    );
    let drivers = host.drivers::<dyn Sensor>();
    let open = || drivers[0].open(&Args::default(), &mut Rig::new());
    let mut sensor = open().expect("a sensor");
    sensor.start(LONG).expect("started");
    let error = capture(&mut *sensor).expect_err("it crashes");
    assert_eq!(error.kind(), ErrorKind::Disconnected);
    drop(sensor);
    let error = open().map(drop).expect_err("in quarantine");
    assert_eq!(error.kind(), ErrorKind::PermissionDenied);
    assert!(
        error.to_string().contains("taceva plugin release"),
        "{error}"
    );
    assert_eq!(libraries_loaded(), 0);
}
