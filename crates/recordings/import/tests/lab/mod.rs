//! Generated folder of a lab: a table, a map and frames.

use std::fs;
use std::io::Cursor;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage};
use taceva_core::SilentProgress;
use taceva_import::{ImportError, ImportMap, ImportPlan, ImportReport};
use tempfile::TempDir;

pub(crate) const MAP: &str = r#"map_version = 2
table = "labels.csv"

[frame]
column = "file"
channel_order = "gray"
reference = "unknown"

[columns]
Fz = { from = "force", unit = "mN", sign = -1 }
Pz = { from = "depth", unit = "um" }

[ids]
sample = "name"
point_id = ["x", "y"]
repeat = "repeat"
phase = "phase"

[attributes]
video = "video"

[time]
column = "t"
unit = "ms"
clock = "monotonic"

[drop]
quality_flags = ["bad"]

[sensor]
model = "drawn"
serial = "unknown"
gel = "unknown"
opaque = true
"#;

/// Folder with a valid table, map and frames, which a test then damages.
pub(crate) struct Lab {
    pub(crate) folder: TempDir,
}

impl Lab {
    pub(crate) fn new() -> Lab {
        let folder = tempfile::tempdir().expect("a folder");
        let lab = Lab { folder };
        fs::create_dir_all(lab.path("source/images")).expect("created");
        let mut table = "file,name,x,y,repeat,phase,video,force,depth,t,quality_flags\n".to_owned();
        for row in 0..5 {
            table += &format!(
                "images/{row}.png,press {row},{row},1,{row}.0,load,\"clip, {row}\",{},{},{},\n",
                -100.5 * f64::from(row) - 1500.0,
                1234.5 + f64::from(row),
                1000 + row,
            );
            lab.write(&format!("source/images/{row}.png"), &png(8, 6, row));
        }
        table += "images/9.png,press 9,1,1,,,,1e6,,,bad;worse\n";
        lab.write("source/labels.csv", table.as_bytes());
        lab.write("map.toml", MAP.as_bytes());
        lab
    }

    pub(crate) fn path(&self, relative: &str) -> PathBuf {
        self.folder.path().join(relative)
    }

    pub(crate) fn write(&self, relative: &str, bytes: &[u8]) {
        fs::write(self.path(relative), bytes).expect("written");
    }

    pub(crate) fn replace(&self, relative: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.path(relative)).expect("read");
        assert!(text.contains(from), "{relative} has no {from:?}");
        self.write(relative, text.replacen(from, to, 1).as_bytes());
    }

    pub(crate) fn import_to(&self, target: &str, jobs: usize) -> Result<ImportReport, ImportError> {
        let map = ImportMap::read(&self.path("map.toml"))?;
        import(&self.path("source"), &map, &self.path(target), jobs)
    }

    pub(crate) fn import(&self) -> Result<ImportReport, ImportError> {
        self.import_to("set", 2)
    }

    /// Message of an import that must fail and leave no files.
    #[track_caller]
    pub(crate) fn refusal(&self) -> String {
        let before = names(self.folder.path());
        let message = match self.import() {
            Ok(report) => panic!("accepted: {report}"),
            Err(error) => error.to_string(),
        };
        assert_eq!(
            names(self.folder.path()),
            before,
            "something was left: {message}"
        );
        message
    }

    #[track_caller]
    pub(crate) fn is_refused_with(&self, parts: &[&str]) {
        let message = self.refusal();
        for part in parts {
            assert!(message.contains(part), "no {part:?} in: {message}");
        }
    }
}

pub(crate) fn import(
    source: &Path,
    map: &ImportMap,
    target: &Path,
    jobs: usize,
) -> Result<ImportReport, ImportError> {
    let jobs = NonZeroUsize::new(jobs).expect("at least one");
    ImportPlan::new(source, map)?.run(target, jobs, &SilentProgress)
}

fn names(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("listed");
    let mut names: Vec<PathBuf> = entries.map(|entry| entry.expect("listed").path()).collect();
    names.sort();
    names
}

/// PNG of a gray picture that depends on `seed`.
pub(crate) fn png(width: u32, height: u32, seed: u32) -> Vec<u8> {
    let image = GrayImage::from_fn(width, height, |x, y| {
        Luma([(x * 31 + y * 17 + seed * 7).to_le_bytes()[0]])
    });
    encoded(image.into(), ImageFormat::Png)
}

/// JPEG of a coloured picture that depends on `seed`.
pub(crate) fn jpeg(width: u32, height: u32, seed: u32) -> Vec<u8> {
    encoded(coloured(width, height, seed), ImageFormat::Jpeg)
}

/// PNG of a coloured picture that depends on `seed`.
pub(crate) fn rgb_png(width: u32, height: u32, seed: u32) -> Vec<u8> {
    encoded(coloured(width, height, seed), ImageFormat::Png)
}

fn coloured(width: u32, height: u32, seed: u32) -> DynamicImage {
    RgbImage::from_fn(width, height, |x, y| {
        Rgb([x * 9 + seed, y * 11, x * y].map(|value| value.to_le_bytes()[0]))
    })
    .into()
}

fn encoded(image: DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    image
        .write_to(&mut Cursor::new(&mut bytes), format)
        .expect("encodes");
    bytes
}
