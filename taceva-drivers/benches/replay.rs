//! Cost of a replay compared with reading and decoding its frames, one 640 × 480 frame per iteration.

use std::fs;
use std::path::Path;

use divan::{Bencher, black_box};
use image::RgbImage;
use taceva_core::{Args, Deadline, Factory, FrameMut, Rig};
use taceva_drivers::ReplayFactory;
use tempfile::TempDir;

fn main() {
    divan::main();
}

/// Folder with one frame that a PNG or JPEG encoder cannot make trivial.
fn folder(name: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let picture = RgbImage::from_fn(640, 480, |x, y| {
        let shade = |scale: u32| ((x * scale) ^ (y * 3)).to_le_bytes()[0] / 4 + 100;
        image::Rgb([shade(1), shade(2), shade(5)])
    });
    picture.save(folder.path().join(name)).expect("written");
    folder
}

const NAMES: [&str; 2] = ["frame.png", "frame.jpg"];

#[divan::bench(args = NAMES)]
fn read_and_decode(bencher: Bencher<'_, '_>, name: &str) {
    let folder = folder(name);
    let path = folder.path().join(name);
    bencher.bench(|| decode(black_box(&path)));
}

fn decode(path: &Path) -> RgbImage {
    let bytes = fs::read(path).expect("there");
    let picture = image::load_from_memory(&bytes).expect("whole");
    picture.into_rgb8()
}

#[divan::bench(args = NAMES)]
fn replay(bencher: Bencher<'_, '_>, name: &str) {
    let folder = folder(name);
    let factory = ReplayFactory::new().expect("no contradiction");
    let text = format!("repeat=true;folder={}", folder.path().display());
    let args: Args = factory.descriptor().args(&text).expect("good");
    let mut sensor = factory.open(&args, &mut Rig::new()).expect("opens");
    let patience = Deadline::after(std::time::Duration::from_secs(2));
    sensor.start(patience).expect("starts");
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    bencher.bench_local(|| {
        let frame = FrameMut::new(info, &mut pixels).expect("of that size");
        sensor.capture(frame, patience).expect("a frame")
    });
}
