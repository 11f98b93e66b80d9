//! Tasks of depth maps: location of the maps, and meaning of their numbers.

use serde::Deserialize;
use toml::Spanned;

use super::{Check, TaskMap, WrittenFrom, WrittenTask, WrittenUnits};
use taceva_dataset::{DatasetError, MapFacts, Task};

/// Array with one depth map for each row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapArray {
    /// File relative to the imported folder.
    pub(crate) file: String,
    /// Name of the array in the file; `None` for its only array.
    pub(crate) path: Option<String>,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "a file, or { file = FILE, path = NAME }")]
pub(super) enum WrittenArray {
    File(String),
    Array(WrittenArrayPath),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenArrayPath {
    file: String,
    path: String,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "\"nan\", or the number of an invalid pixel")]
pub(super) enum Invalid {
    Number(f64),
    Word(String),
}

impl WrittenTask {
    /// True if the task has keys of depth maps.
    pub(super) fn is_of_maps(&self) -> bool {
        self.array.is_some()
            || self.scale.is_some()
            || self.pixel_mm.is_some()
            || self.invalid.is_some()
    }
}

impl Check<'_> {
    pub(super) fn maps_of(
        &self,
        mut task: Task,
        written: WrittenTask,
        offset: usize,
    ) -> Result<TaskMap, DatasetError> {
        let name = task.name.clone();
        let is_other = written.names.is_some()
            || written.positive.is_some()
            || written.over.is_some()
            || written.thresholds.is_some();
        let (from, array) = match (written.from, written.array) {
            (Some(WrittenFrom::Column(column)), None) if !is_other => {
                (vec![column.into_name()], None)
            }
            (None, Some(array)) if !is_other => (Vec::new(), Some(self.map_array(array)?)),
            _ => {
                let problem = format!(
                    "[task.{name}] needs `array = \"FILE\"` with the maps of all rows, or `from`, a column that names a .png or .npy for each row; remove `names`, `positive`, `over` and `thresholds`"
                );
                return Err(self.at(offset, &problem));
            }
        };
        let (symbol, at) = match &written.unit {
            Some(unit) => match unit.get_ref() {
                WrittenUnits::One(symbol) => (symbol.as_str(), unit.span().start),
                WrittenUnits::Several(_) => {
                    let problem =
                        "invalid `unit` of depth maps, expected one unit of length, such as \"mm\"";
                    return Err(self.at(unit.span().start, problem));
                }
            },
            None => {
                let problem = format!("[task.{name}] needs `unit` of its depths, such as \"mm\"");
                return Err(self.at(offset, &problem));
            }
        };
        self.length(symbol, at)?;
        let mut facts = MapFacts::new(symbol);
        if let Some(scale) = &written.scale {
            facts.scale = self.number(scale, "scale", |scale| scale != 0.0)?;
        }
        if let Some(pixel) = &written.pixel_mm {
            let sides = *pixel.get_ref();
            if !sides.iter().all(|side| (1e-9..=1e9).contains(side)) {
                let problem = "invalid `pixel_mm`, expected the distances of columns and of rows, two numbers from 1e-9 to 1e9 mm";
                return Err(self.at(pixel.span().start, problem));
            }
            facts.pixel_mm = Some(sides);
        }
        if let Some(invalid) = &written.invalid {
            facts.invalid = match invalid.get_ref() {
                Invalid::Word(word) if word == "nan" => None,
                Invalid::Number(number) if number.is_nan() => None,
                Invalid::Number(number) if number.is_finite() => Some(*number),
                _ => {
                    let problem = "unknown value of `invalid`, expected \"nan\", or the number of an invalid pixel";
                    return Err(self.at(invalid.span().start, problem));
                }
            };
        }
        task.from = from;
        task.frame = written.frame;
        task.maps = Some(facts);
        Ok(TaskMap {
            task,
            units: Vec::new(),
            array,
        })
    }

    fn number(
        &self,
        written: &Spanned<f64>,
        key: &str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Result<f64, DatasetError> {
        let number = *written.get_ref();
        if number.is_finite() && is_allowed(number) {
            return Ok(number);
        }
        let problem = format!("`{key}` is {number}, expected a number other than 0");
        Err(self.at(written.span().start, &problem))
    }

    fn map_array(&self, written: Spanned<WrittenArray>) -> Result<MapArray, DatasetError> {
        let at = written.span().start;
        let array = match written.into_inner() {
            WrittenArray::File(file) => MapArray { file, path: None },
            WrittenArray::Array(array) => MapArray {
                file: array.file,
                path: Some(array.path),
            },
        };
        self.relative(&array.file, at)?;
        Ok(array)
    }
}
