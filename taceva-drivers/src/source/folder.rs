//! A folder of images as a recording.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use taceva_core::shown;

use taceva_core::{FrameInfo, FrameMut, Hertz};

use super::decode::{self, Mismatch};
use super::error::SourceError;
use super::{FrameSource, limits, times};
use crate::name_order;

/// Times of the frames in a folder.
#[derive(Clone, Debug, PartialEq)]
pub enum Timing {
    /// Constant rate: the first frame is at 0 s, and the frames are in natural order of their file names.
    Rate(Hertz),
    /// CSV table with the columns `file` and `t_s`, which names every frame of the folder once.
    Table(PathBuf),
}

/// PNG and JPEG files of one folder, each read on request.
///
/// Other files are ignored. Links to images are rejected.
#[derive(Debug)]
pub struct FolderSource {
    files: Vec<PathBuf>,
    times_s: Vec<f64>,
    info: FrameInfo,
    encoded: Vec<u8>,
}

impl FolderSource {
    /// Opens the frames in `folder`. Reads the first frame, and the table of times if it exists.
    ///
    /// # Errors
    /// [`SourceError`] if the folder is missing or empty, its first frame is damaged, or the table does not match.
    pub fn open(folder: &Path, timing: &Timing) -> Result<FolderSource, SourceError> {
        let names = names_in(folder)?;
        let (names, times_s) = match timing {
            Timing::Rate(rate) => steady(names, *rate),
            Timing::Table(table) => timed(names, table)?,
        };
        let files: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
        let mut encoded = Vec::new();
        let first = &files[0];
        read_into(&mut encoded, first)?;
        let info = decode::info(&encoded).map_err(|problem| SourceError::Frame {
            path: first.clone(),
            problem,
        })?;
        Ok(FolderSource {
            files,
            times_s,
            info,
            encoded,
        })
    }
}

impl FrameSource for FolderSource {
    fn info(&self) -> FrameInfo {
        self.info
    }

    fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    fn read(&mut self, position: usize, mut into: FrameMut<'_>) -> Result<(), SourceError> {
        let path = &self.files[position];
        read_into(&mut self.encoded, path)?;
        decode::decode(&self.encoded, &mut into).map_err(|mismatch| match mismatch {
            Mismatch::Size(found) => SourceError::Size {
                path: path.clone(),
                expected: self.info,
                found,
            },
            Mismatch::Damaged(problem) => SourceError::Frame {
                path: path.clone(),
                problem,
            },
        })
    }
}

/// Names of the images in `folder` in natural order; at least one.
fn names_in(folder: &Path) -> Result<Vec<String>, SourceError> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(SourceError::io("read the folder", folder))? {
        let entry = entry.map_err(SourceError::io("read the folder", folder))?;
        let path = entry.path();
        let kind = entry
            .file_type()
            .map_err(SourceError::io("read the file type of", &path))?;
        if !is_picture(&path) || kind.is_dir() {
            continue;
        }
        let refused = |problem: &str| SourceError::Frame {
            path: path.clone(),
            problem: problem.to_owned(),
        };
        if !kind.is_file() {
            return Err(refused("a link or a device, expected a regular file"));
        }
        let name = entry.file_name().into_string();
        let name = name.map_err(|_| refused("its name is not UTF-8: rename the file"))?;
        if names.len() == limits::FRAMES {
            return Err(SourceError::TooMany {
                folder: folder.to_owned(),
                most: limits::FRAMES,
            });
        }
        names.push(name);
    }
    if names.is_empty() {
        return Err(SourceError::Empty {
            folder: folder.to_owned(),
        });
    }
    names.sort_by(|first, second| name_order::compare(first, second));
    Ok(names)
}

fn is_picture(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    ["png", "jpg", "jpeg"]
        .iter()
        .any(|known| extension.eq_ignore_ascii_case(known))
}

fn steady(names: Vec<String>, rate: Hertz) -> (Vec<String>, Vec<f64>) {
    #[expect(clippy::cast_precision_loss, reason = "at most 2^20 frames")]
    let times_s = (0..names.len()).map(|position| position as f64 / rate.0);
    let times_s = times_s.collect();
    (names, times_s)
}

fn timed(names: Vec<String>, table: &Path) -> Result<(Vec<String>, Vec<f64>), SourceError> {
    let fault = |line: Option<u64>, problem: String| SourceError::Times {
        path: table.to_owned(),
        line,
        problem,
    };
    let mut unnamed: BTreeSet<&str> = names.iter().map(String::as_str).collect();
    let rows = times::read(table)?;
    for row in &rows {
        if !unnamed.remove(row.name.as_str()) {
            let name = shown(&row.name);
            let problem = if names.contains(&row.name) {
                format!("`{name}` occurs twice, expected one row per frame")
            } else {
                format!("`{name}` is not a frame in the folder, expected the name of a file in it")
            };
            return Err(fault(Some(row.line), problem));
        }
    }
    if let Some(name) = unnamed.first() {
        let problem = format!(
            "no row for `{}`, expected one for every frame in the folder",
            shown(name)
        );
        return Err(fault(None, problem));
    }
    Ok(rows.into_iter().map(|row| (row.name, row.time_s)).unzip())
}

/// Reads a file into a reused buffer.
fn read_into(buffer: &mut Vec<u8>, path: &Path) -> Result<(), SourceError> {
    buffer.clear();
    let file = File::open(path).map_err(SourceError::io("open", path))?;
    let length = file
        .metadata()
        .map_err(SourceError::io("read", path))?
        .len();
    if length > limits::IMAGE_BYTES {
        return Err(SourceError::Frame {
            path: path.to_owned(),
            problem: format!("{length} bytes, expected at most {}", limits::IMAGE_BYTES),
        });
    }
    file.take(limits::IMAGE_BYTES)
        .read_to_end(buffer)
        .map_err(SourceError::io("read", path))?;
    Ok(())
}
