//! Folders of frames for the tests that replay them.

use std::path::Path;
use std::time::Duration;

use image::{GrayImage, Luma};
use taceva_core::{Deadline, DriverError, FrameMut, Rig, Sensor, Stamp};
use taceva_drivers::{Drivers, OpenError, open};
use tempfile::TempDir;

/// Long enough for every frame of a test.
pub(crate) const PATIENCE: Deadline = Deadline::after(Duration::from_secs(5));

/// A folder of `count` gray frames, 8 × 6 pixels, each of its own shade: `frame 1.png` is all 1.
pub(crate) fn folder(count: u8) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for shade in 1..=count {
        gray(
            shade,
            8,
            6,
            &folder.path().join(format!("frame {shade}.png")),
        );
    }
    folder
}

/// A gray picture of one shade.
pub(crate) fn gray(shade: u8, width: u32, height: u32, path: &Path) {
    GrayImage::from_pixel(width, height, Luma([shade]))
        .save(path)
        .expect("written");
}

/// Opens a driver by its selector.
pub(crate) fn sensor(selector: &str) -> Result<Box<dyn Sensor>, OpenError> {
    let drivers = Drivers::builtin().expect("no contradiction");
    let selector = selector.parse().expect("a selector");
    open(&drivers.sensors, &selector, &mut Rig::new())
}

/// The replay of a folder, started.
pub(crate) fn replay(folder: &Path, more: &str) -> Box<dyn Sensor> {
    let selector = format!("sensor/replay:folder={}{more}", folder.display());
    let mut sensor = sensor(&selector).expect("opens");
    sensor.start(PATIENCE).expect("starts");
    sensor
}

/// The next frame, as its stamp and its first pixel.
pub(crate) fn capture(
    sensor: &mut dyn Sensor,
    deadline: Deadline,
) -> Result<(Stamp, u8), DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    let frame = FrameMut::new(info, &mut pixels).expect("of that size");
    let stamp = sensor.capture(frame, deadline)?;
    Ok((stamp, pixels[0]))
}
