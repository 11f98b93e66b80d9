//! Folders of frames for the tests that replay them.

use std::path::Path;
use std::time::Duration;

use image::{GrayImage, Luma};
use taceva_core::{Deadline, DriverError, FrameMut, Rig, Sensor, Stamp};
use taceva_drivers::{Drivers, OpenError, open};
use tempfile::TempDir;

/// Deadline for every frame of a test.
pub(crate) const PATIENCE: Deadline = Deadline::after(Duration::from_secs(5));

/// Writes a folder of `count` gray frames, 8 × 6 pixels, each with its own shade: all pixels of `frame 1.png` are 1.
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

/// Gray image of one shade.
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

/// Opens and starts the replay of a folder.
pub(crate) fn replay(folder: &Path, more: &str) -> Box<dyn Sensor> {
    let selector = format!("sensor/replay:folder={}{more}", folder.display());
    let mut sensor = sensor(&selector).expect("opens");
    sensor.start(PATIENCE).expect("starts");
    sensor
}

/// Captures the next frame: its stamp and its first pixel.
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
