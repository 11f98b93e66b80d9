//! Test folder to import, as a laboratory would have it: pictures, a table of labels, and a map file.

use std::path::{Path, PathBuf};

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use crate::random::Random;

/// Format of a picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// PNG: lossless, with a checksum of every part.
    Png,
    /// JPEG: lossy, without a checksum.
    Jpeg,
}

impl Form {
    /// File name extension.
    pub fn extension(self) -> &'static str {
        match self {
            Form::Png => "png",
            Form::Jpeg => "jpg",
        }
    }
}

/// Image file of a gray picture of 48×36 pixels: a brightness ramp with noise. Pictures with different `number` differ, and no pixel is predictable.
///
/// # Panics
/// If the encoder fails, which ends the test.
pub fn picture(form: Form, number: u32) -> Vec<u8> {
    const WIDTH: u32 = 48;
    const HEIGHT: u32 = 36;
    let mut random = Random::new(u64::from(number));
    let pixels: Vec<u8> = (0..WIDTH * HEIGHT)
        .map(|pixel| {
            let noise = random.bits().to_le_bytes()[0] % 32;
            let slope = (pixel % WIDTH + 3 * number).to_le_bytes()[0];
            slope.wrapping_add(noise)
        })
        .collect();
    let mut file = Vec::new();
    let gray = ExtendedColorType::L8;
    let encoded = match form {
        Form::Png => PngEncoder::new(&mut file).write_image(&pixels, WIDTH, HEIGHT, gray),
        Form::Jpeg => {
            JpegEncoder::new_with_quality(&mut file, 90).write_image(&pixels, WIDTH, HEIGHT, gray)
        }
    };
    encoded.expect("a small gray picture can be encoded");
    file
}

/// A folder with pictures, a table of labels, and a map file that describes their import.
#[derive(Debug)]
pub struct Lab {
    folder: tempfile::TempDir,
}

impl Lab {
    /// Creates a folder in which row `n` of the table names picture `n` of `pictures`. The map file states `order` as their order of colours.
    ///
    /// # Panics
    /// If the folder cannot be written, which ends the test.
    pub fn new(form: Form, order: &str, pictures: &[Vec<u8>]) -> Lab {
        Lab::numbered(form, order, pictures, 0)
    }

    /// Creates a folder with `count` drawn gray pictures, numbered from `first` on.
    ///
    /// # Panics
    /// If the folder cannot be written, which ends the test.
    pub fn drawn_from(form: Form, first: usize, count: usize) -> Lab {
        let number = |number| u32::try_from(number).expect("a small number");
        let pictures: Vec<Vec<u8>> = (first..first + count)
            .map(|own| picture(form, number(own)))
            .collect();
        Lab::numbered(form, "gray", &pictures, first)
    }

    fn numbered(form: Form, order: &str, pictures: &[Vec<u8>], first: usize) -> Lab {
        let folder = scratch();
        let frames = folder.path().join("frames");
        std::fs::create_dir(&frames).expect("a new folder");
        let mut labels = String::from("file,depth_mm,force_N,point\n");
        for (number, bytes) in (first..).zip(pictures) {
            let name = format!("{number:03}.{}", form.extension());
            std::fs::write(frames.join(&name), bytes).expect("written");
            let (point, step) = (number / 2, number % 2 + 1);
            labels += &format!("frames/{name},0.{step},{step}.{number:03},{point}\n");
        }
        std::fs::write(folder.path().join("labels.csv"), labels).expect("written");
        let map = MAP.replace("{order}", order);
        std::fs::write(folder.path().join("map.toml"), map).expect("written");
        Lab { folder }
    }

    /// Creates a folder with `count` drawn gray pictures.
    pub fn drawn(form: Form, count: u32) -> Lab {
        let pictures: Vec<Vec<u8>> = (0..count).map(|number| picture(form, number)).collect();
        Lab::new(form, "gray", &pictures)
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Path of the map file.
    pub fn map(&self) -> PathBuf {
        self.path().join("map.toml")
    }

    /// Path of the picture of row `number`.
    pub fn picture(&self, form: Form, number: usize) -> PathBuf {
        self.path()
            .join(format!("frames/{number:03}.{}", form.extension()))
    }
}

/// Creates a folder in memory if possible, otherwise among temporary files, because tests create thousands of files.
///
/// # Panics
/// If the folder cannot be created, which ends the test.
pub fn scratch() -> tempfile::TempDir {
    let in_memory = tempfile::tempdir_in("/dev/shm");
    in_memory
        .or_else(|_| tempfile::tempdir())
        .expect("a place for temporary files")
}

const MAP: &str = r#"map_version = 2
table = "labels.csv"

[frame]
column = "file"
channel_order = "{order}"
reference = "unknown"

[columns]
Pz = { from = "depth_mm", unit = "mm" }
Fz = { from = "force_N", unit = "N" }

[ids]
sample = "file"
point_id = "point"

[time]
clock = "unknown"

[sensor]
model = "made up"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;
