//! Benchmark of a plugin's frames in this process, compared with a copy of as many bytes: `cargo bench -p taceva-host --bench plugins`.

#[path = "../tests/plugins/fixture.rs"]
#[expect(dead_code, reason = "the tests use more of it")]
mod fixture;

use std::fs;
use std::time::Duration;

use divan::{Bencher, black_box};
use fixture::{EYE, Fixture};
use taceva_core::{Args, Deadline, FrameMut, Sensor};
use taceva_host::{PluginSensor, Plugins, SearchPath, libraries_loaded};
use tempfile::TempDir;

fn main() {
    divan::main();
}

const BYTES: usize = 640 * 480 * 3;
const LONG: Deadline = Deadline::after(Duration::from_secs(10));

/// 640×480 camera of a C plugin that lends its image without waiting for an exposure; `None` without a C compiler.
fn camera() -> Option<PluginSensor> {
    let fixture = Fixture::built(&["WIDTH=640", "HEIGHT=480", "LEND", "FREE_RUNNING"])?;
    let fixture = fixture.with_manifest("width = 8, height = 6", "width = 640, height = 480");
    let opened = fixture.session().open_sensor(&EYE, &Args::default());
    let mut camera = opened.expect("opens");
    camera.start(LONG).expect("starts");
    Some(camera)
}

/// Copy of a frame's bytes within this process.
#[divan::bench]
fn copy(bencher: Bencher<'_, '_>) {
    let (from, mut into) = (vec![7_u8; BYTES], vec![0_u8; BYTES]);
    bencher.bench_local(|| black_box(&mut into).copy_from_slice(black_box(&from)));
}

/// Frame read in the plugin's memory.
#[divan::bench]
fn borrowed(bencher: Bencher<'_, '_>) {
    if let Some(mut camera) = camera() {
        bencher.bench_local(|| {
            camera
                .lend(LONG, |frame| black_box(frame.bytes[0]))
                .expect("a frame")
        });
    }
}

/// Frame copied from the plugin's memory.
#[divan::bench]
fn copied(bencher: Bencher<'_, '_>) {
    if let Some(mut camera) = camera() {
        let info = camera.frame_info();
        let mut pixels = vec![0; BYTES];
        bencher.bench_local(|| {
            let into = FrameMut::new(info, &mut pixels).expect("fits");
            camera.capture(into, LONG).expect("a frame")
        });
    }
}

/// 200 plugins with four drivers and an estimator each.
fn many() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for number in 0..200 {
        let within = folder.path().join(format!("{number:03}"));
        fs::create_dir(&within).expect("made");
        let manifest =
            fixture::MANIFEST.replace("org.example.fixture", &format!("org.example.n{number}"));
        fs::write(within.join("plugin.toml"), manifest).expect("written");
        fs::write(within.join("libfixture.so"), "never opened").expect("written");
    }
    folder
}

/// Search of 200 manifests. Opens no library.
#[divan::bench]
fn list_200_manifests(bencher: Bencher<'_, '_>) {
    let folder = many();
    let before = libraries_loaded();
    bencher.bench_local(|| {
        let path = SearchPath::empty().given([folder.path().to_owned()]);
        let plugins = Plugins::search(path, &[]);
        assert_eq!(plugins.len(), 200);
        plugins
    });
    assert_eq!(
        libraries_loaded(),
        before,
        "a library was opened to list it"
    );
}
