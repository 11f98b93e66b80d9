//! WebDataset shards. Tar members whose names agree up to the first dot form one sample. Pictures are read directly from the archive.

mod samples;

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::Value;
use taceva_arrays::ArrayFile;

use super::columns::{ColumnSource, PictureColumn, PictureKind};
use super::json::json_problem;
use super::pictures::{Picture, Pictures, Visit};
use crate::error::ImportError;
use crate::frame_names::FrameNames;
use samples::{Extent, Sample, bytes_at, samples};
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::{ImageKind, limits};

/// Number of samples that are searched for members of their JSON.
const LOOKED_AT: usize = 100;
/// Maximum size of a JSON or text member, bytes.
const TEXT_BYTES: u64 = 1 << 20;
/// Maximum size of an array member, bytes.
const ARRAY_BYTES: u64 = 1 << 26;
/// Filename extensions of text members.
const TEXTS: [&str; 4] = ["txt", "text", "cls", "id"];

/// Samples of a shard.
#[derive(Debug)]
pub(super) struct Shard {
    path: PathBuf,
    samples: Arc<Vec<Sample>>,
}

impl Shard {
    pub(super) fn open(path: &Path) -> Result<Shard, String> {
        let is_packed = path.extension().is_some_and(|ending| ending != "tar");
        if is_packed {
            return Err(
                "shards are read in place, and this one is compressed: `gunzip` it first"
                    .to_owned(),
            );
        }
        let samples = samples(path).map_err(|error| error.to_string())?;
        Ok(Shard {
            path: path.to_owned(),
            samples: Arc::new(samples),
        })
    }

    fn bytes(&self, place: Extent, cap: u64) -> Result<Vec<u8>, String> {
        let mut file = File::open(&self.path).map_err(|error| error.to_string())?;
        bytes_at(&mut file, place, cap)
    }

    fn text(&self, sample: &Sample, name: &str) -> Result<Option<String>, String> {
        let Some(place) = sample.parts.get(name) else {
            return Ok(None);
        };
        let text = String::from_utf8(self.bytes(*place, TEXT_BYTES)?);
        text.map(Some)
            .map_err(|_| format!("`{}.{name}` is not UTF-8 text", sample.key))
    }

    /// JSON of a sample in the field `field`.
    fn json(&self, sample: &Sample, field: &str) -> Result<Option<Value>, String> {
        let Some(text) = self.text(sample, field)? else {
            return Ok(None);
        };
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        serde_json::from_str(text).map(Some).map_err(|error| {
            let (line, problem) = (error.line(), json_problem(text, &error));
            format!(
                "`{}.{field}`, line {line}: invalid JSON: {problem}",
                sample.key
            )
        })
    }

    fn has_json(&self, field: &str, pointer: &str) -> bool {
        let mut first = self.samples.iter().take(LOOKED_AT);
        first.any(|sample| {
            let value = self.json(sample, field).ok().flatten();
            value.is_some_and(|value| value.pointer(pointer).is_some())
        })
    }

    /// Array of a sample in the field `field`, as nested lists; empty if the sample lacks the field.
    fn array(&self, sample: &Sample, field: &str) -> Result<String, String> {
        let Some(place) = sample.parts.get(field) else {
            return Ok(String::new());
        };
        let wrong = |problem: String| format!("`{}.{field}`: {problem}", sample.key);
        let bytes = self.bytes(*place, ARRAY_BYTES).map_err(wrong)?;
        let file = ArrayFile::of_npy(&self.path, bytes);
        let file = file.map_err(|error| wrong(error.problem.to_string()))?;
        let info = file
            .info("value")
            .ok_or_else(|| wrong("not an array of numbers".to_owned()))?;
        let shape = info.shape.clone();
        let rows = shape.first().copied().unwrap_or(1);
        let read = file.read("value", 0..rows);
        let read = read.map_err(|error| wrong(error.problem.to_string()))?;
        let numbers = read.values.to_f64();
        let numbers = numbers.ok_or_else(|| wrong("not an array of numbers".to_owned()))?;
        Ok(nested(&shape, &numbers))
    }

    fn cell(&self, sample: &Sample, name: &str) -> Result<String, String> {
        if name == "key" {
            return Ok(sample.key.clone());
        }
        match Field::of(name) {
            Field::Text(field) => {
                let text = self.text(sample, field)?.unwrap_or_default();
                Ok(text.trim().to_owned())
            }
            Field::Array(field) => self.array(sample, field),
            Field::Json(field, pointer) => {
                let value = self.json(sample, field)?;
                let found = value.as_ref().and_then(|value| value.pointer(pointer));
                Ok(match found {
                    None | Some(Value::Null) => String::new(),
                    Some(Value::String(text)) => text.trim().to_owned(),
                    Some(value) => value.to_string(),
                })
            }
        }
    }

    /// Fields of the first sample with one of these endings: `meta.json`, `fz.cls`.
    fn fields(&self, endings: &[&str]) -> Vec<String> {
        let first = self.samples.first().into_iter();
        let parts = first.flat_map(|first| first.parts.keys());
        let fields = parts.filter(|part| endings.contains(&ending_of(part)));
        fields.map(ToString::to_string).collect()
    }
}

/// Member of a sample that a column name refers to.
enum Field<'n> {
    Text(&'n str),
    Array(&'n str),
    /// Name of the field, and the JSON pointer into its value.
    Json(&'n str, &'n str),
}

impl<'n> Field<'n> {
    fn of(name: &'n str) -> Field<'n> {
        let (field, pointer) = name.split_at(name.find('/').unwrap_or(name.len()));
        match ending_of(field) {
            "json" => Field::Json(field, pointer),
            "npy" => Field::Array(name),
            _ => Field::Text(name),
        }
    }
}

/// Ending of a field: `json` of `meta.json`.
fn ending_of(field: &str) -> &str {
    field.rsplit_once('.').map_or(field, |(_, ending)| ending)
}

/// Nested lists of the shape `shape` of `numbers`, each in the shortest form that parses back.
fn nested(shape: &[u64], numbers: &[f64]) -> String {
    match shape {
        [] => numbers
            .first()
            .map_or_else(String::new, |number| format!("{number:?}")),
        [_] => format!("{numbers:?}"),
        [rows, rest @ ..] => {
            let length = numbers.len() / usize::try_from(*rows).unwrap_or(1).max(1);
            let lists = numbers.chunks(length.max(1)).map(|own| nested(rest, own));
            format!("[{}]", lists.collect::<Vec<_>>().join(", "))
        }
    }
}

impl ColumnSource for Shard {
    fn rows(&self) -> usize {
        self.samples.len()
    }

    fn names(&self) -> Vec<String> {
        let Some(first) = self.samples.first() else {
            return Vec::new();
        };
        let mut names = vec!["key".to_owned()];
        names.extend(self.fields(&TEXTS));
        names.extend(self.fields(&["npy"]));
        for field in self.fields(&["json"]) {
            let members = self.json(first, &field).ok().flatten();
            let members = members.as_ref().and_then(Value::as_object);
            let members = members.into_iter().flatten();
            names.extend(members.map(|(name, _)| format!("{field}/{name}")));
        }
        names
    }

    fn has(&self, name: &str) -> bool {
        let is_field = |field: &str| {
            let mut samples = self.samples.iter();
            samples.any(|sample| sample.parts.contains_key(field))
        };
        match Field::of(name) {
            _ if name == "key" => true,
            Field::Json(field, pointer) => !pointer.is_empty() && self.has_json(field, pointer),
            Field::Array(field) => is_field(field),
            Field::Text(field) => TEXTS.contains(&ending_of(field)) && is_field(field),
        }
    }

    /// Unread members, whose forms are not supported, such as TenBin and pickles.
    fn unread(&self) -> Vec<String> {
        let first = self.samples.first().into_iter();
        let parts = first.flat_map(|first| &first.parts);
        let is_read = |part: &str, place: Extent| {
            let ending = ending_of(part);
            TEXTS.contains(&ending)
                || ["npy", "json"].contains(&ending)
                || self
                    .bytes(place, limits::IMAGE_BYTES)
                    .is_ok_and(|bytes| ImageKind::of(&bytes).is_some())
        };
        let others = parts.filter(|(part, place)| !is_read(part, **place));
        others
            .map(|(part, _)| {
                format!("`.{part}` of its samples: write numbers as `.npy`, `.json` or `.cls`")
            })
            .collect()
    }

    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        let column = |name: &&str| {
            self.samples
                .iter()
                .map(|sample| self.cell(sample, name))
                .collect()
        };
        names.iter().map(column).collect()
    }

    /// True if the column contains JSON integers, and no other values. Text members have no type.
    fn holds_integers(&self, name: &str) -> bool {
        let Field::Json(field, pointer) = Field::of(name) else {
            return false;
        };
        let mut found = 0;
        self.samples.iter().all(|sample| {
            let value = self.json(sample, field).ok().flatten();
            match value.as_ref().and_then(|value| value.pointer(pointer)) {
                None | Some(Value::Null) => true,
                Some(value) => {
                    found += 1;
                    value.is_i64() || value.is_u64()
                }
            }
        }) && found > 0
    }

    fn picture_columns(&self) -> Vec<PictureColumn> {
        let parts = self
            .samples
            .first()
            .into_iter()
            .flat_map(|first| &first.parts);
        let pictures = parts.filter(|(_, place)| {
            let bytes = self.bytes(**place, limits::IMAGE_BYTES);
            bytes.is_ok_and(|bytes| ImageKind::of(&bytes).is_some())
        });
        let column = |(name, _): (&Arc<str>, _)| PictureColumn {
            name: name.to_string(),
            kind: PictureKind::Encoded,
            order: None,
        };
        pictures.map(column).collect()
    }

    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        let FrameNames::Bytes(ending) = names else {
            return Err("pictures in a shard are encoded: set `bytes` to the ending of their names, such as \"jpg\"".to_owned());
        };
        let ending = ending.to_ascii_lowercase();
        if let Some(without) = self
            .samples
            .iter()
            .find(|sample| !sample.parts.contains_key(ending.as_str()))
        {
            let there: Vec<&str> = without.parts.keys().map(|known| &**known).collect();
            return Err(format!(
                "sample `{}` has no `.{ending}`, but {}",
                without.key,
                there.join(", ")
            ));
        }
        Ok(Arc::new(ShardPictures {
            path: self.path.clone(),
            samples: Arc::clone(&self.samples),
            ending,
        }))
    }
}

/// Pictures of a shard, one per sample.
#[derive(Debug)]
struct ShardPictures {
    path: PathBuf,
    samples: Arc<Vec<Sample>>,
    ending: String,
}

impl Pictures for ShardPictures {
    fn path(&self) -> &Path {
        &self.path
    }

    fn count(&self) -> u64 {
        self.samples.len() as u64
    }

    fn visit(
        &self,
        sorted: &[u64],
        _order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        let wrong = |problem: String| ImportError::image(&self.path, problem);
        let mut file = File::open(&self.path).map_err(ImportError::io("open", &self.path))?;
        for index in sorted {
            let sample = usize::try_from(*index)
                .ok()
                .and_then(|at| self.samples.get(at));
            let place = sample.and_then(|sample| sample.parts.get(self.ending.as_str()));
            let place = place.ok_or_else(|| wrong(format!("no picture {index}")))?;
            let bytes = bytes_at(&mut file, *place, limits::IMAGE_BYTES).map_err(wrong)?;
            each(*index, Picture::Encoded(bytes))?;
        }
        Ok(())
    }
}
