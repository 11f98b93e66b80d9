//! Schema of the table of a map, with the form given by its path or by `format`.

use std::path::Path;

use serde::Deserialize;
use taceva_arrays::ArrayFormat;
use toml::Spanned;

use super::check::Check;
use crate::csv_table::text_form::TextForm;
use crate::foreign::{TableForm, is_recording};
use taceva_dataset::DatasetError;

/// Table as written in a map: only a path, or a section with keys.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "the path of a table, { file = …, format = …, header = false, rows = …, decimal = \",\", thousands = \".\", comment = \"#\", skip_lines = 2, units_row = true }, { file = \"clip.mp4\", format = \"clip\", rate = 30 }, or { files = … }"
)]
pub(super) enum WrittenTable {
    Path(String),
    Described(WrittenForm),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenForm {
    file: Option<String>,
    files: Option<String>,
    format: Option<Format>,
    header: Option<bool>,
    decimal: Option<String>,
    thousands: Option<String>,
    comment: Option<String>,
    skip_lines: Option<u32>,
    #[serde(default)]
    units_row: bool,
    rows: Option<String>,
    cut: Option<String>,
    #[serde(default)]
    whole: bool,
    rate: Option<f64>,
    start_s: Option<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Format {
    Csv,
    Tsv,
    Json,
    Jsonl,
    Npy,
    Npz,
    Hdf5,
    Zarr,
    Mat,
    Pickle,
    Parquet,
    Arrow,
    Mcap,
    Lerobot,
    Webdataset,
    Clip,
}

impl Format {
    fn of_arrays(self) -> Option<ArrayFormat> {
        Some(match self {
            Format::Csv
            | Format::Tsv
            | Format::Json
            | Format::Jsonl
            | Format::Parquet
            | Format::Arrow
            | Format::Mcap
            | Format::Lerobot
            | Format::Webdataset
            | Format::Clip => return None,
            Format::Npy => ArrayFormat::Npy,
            Format::Npz => ArrayFormat::Npz,
            Format::Hdf5 => ArrayFormat::Hdf5,
            Format::Zarr => ArrayFormat::Zarr,
            Format::Mat => ArrayFormat::Matlab,
            Format::Pickle => ArrayFormat::Pickle,
        })
    }
}

/// Messages of the only topic of a whole recording.
const MESSAGES: TableForm = TableForm::Messages {
    topic: None,
    is_to_cut: false,
};

/// Form of the table at `path`, from `format` or the filename extension.
fn form_of(path: &str, format: Option<Format>) -> TableForm {
    let ending = path
        .rsplit_once('.')
        .map(|(_, ending)| ending.to_ascii_lowercase());
    let arrays = match format {
        Some(format) => format.of_arrays(),
        None => ArrayFormat::of(Path::new(path)),
    };
    if let Some(format) = arrays {
        return TableForm::Arrays {
            format,
            rows: None,
            is_whole: false,
        };
    }
    match (format, ending.as_deref()) {
        (Some(Format::Json), _) | (None, Some("json")) => TableForm::Json { rows: None },
        (Some(Format::Parquet), _) | (None, Some("parquet")) => TableForm::Parquet,
        (Some(Format::Arrow), _) | (None, Some("arrow" | "feather")) => TableForm::Arrow,
        (Some(Format::Lerobot), _) => TableForm::LeRobot,
        (Some(Format::Webdataset), _) | (None, Some("tar")) => TableForm::WebDataset,
        (Some(Format::Mcap), _) => MESSAGES,
        (None, Some(ending)) if is_recording(ending) => MESSAGES,
        (Some(Format::Jsonl), _) | (None, Some("jsonl" | "ndjson")) => TableForm::JsonLines,
        _ => TableForm::Delimited(TextForm::new(true)),
    }
}

/// Command that converts a table of an unreadable form, by its filename extension.
pub(crate) fn converter(path: &str) -> Option<String> {
    // A Lance table is a folder.
    if let Some((table, _)) = format!("{path}/").split_once(".lance/") {
        let (folder, name) = table.rsplit_once('/').unwrap_or((".", table));
        return Some(format!(
            "write a table in Python, with the package lancedb, by \
             `pyarrow.parquet.write_table(lancedb.connect({folder:?}).open_table({name:?}).to_arrow(), \"{name}.parquet\")`"
        ));
    }
    let (stem, ending) = path.rsplit_once('.')?;
    let (stem, file) = match stem.contains('*') {
        true => ("OUT", "FILE"),
        false => (stem, path),
    };
    Some(match ending.to_ascii_lowercase().as_str() {
        "xlsx" | "xls" | "ods" => {
            format!("write a table by `libreoffice --headless --convert-to csv {file}`")
        }
        "zst" | "zstd" => format!("decompress it by `zstd -d {file} -o {stem}`"),
        "rrd" => format!(
            "write a table in Python by `t = pyarrow.Table.from_batches(rerun.server.Server(datasets={{\"d\": \
             [{file:?}]}}).client().get_dataset(name=\"d\")\
             .reader(index=\"frame\").collect())` of `rerun-sdk[catalog]`, and `pyarrow.parquet.write_table(t, \"{stem}.parquet\")` of \
             its columns without tensors"
        ),
        _ => return None,
    })
}

impl Check<'_> {
    /// Checks the file pattern and form of a table.
    pub(super) fn table(
        &self,
        written: &Spanned<WrittenTable>,
    ) -> Result<(String, TableForm), DatasetError> {
        let offset = written.span().start;
        let (file, form) = match written.get_ref() {
            WrittenTable::Path(path) => (path, form_of(path, None)),
            WrittenTable::Described(described) => self.described(described, offset)?,
        };
        if let Some(remedy) = converter(file) {
            return Err(self.at(
                offset,
                &format!("`{file}` has a format that is not read: {remedy}"),
            ));
        }
        self.relative(file, offset)?;
        Ok((file.clone(), form))
    }

    fn described<'w>(
        &self,
        described: &'w WrittenForm,
        offset: usize,
    ) -> Result<(&'w String, TableForm), DatasetError> {
        let (file, form) = match (&described.file, &described.files) {
            (Some(file), None) => (file, form_of(file, described.format)),
            (None, Some(files)) => (files, TableForm::Files),
            _ => {
                return Err(self.at(offset, "a table needs either `file` or `files`"));
            }
        };
        let form = match (form, described.whole) {
            (form, false) => form,
            (TableForm::Arrays { format, .. }, true) if described.rows.is_none() => {
                TableForm::Arrays {
                    format,
                    rows: None,
                    is_whole: true,
                }
            }
            (_, true) => {
                return Err(self.at(
                    offset,
                    "`whole = true` makes a file of arrays one row, and excludes `rows`",
                ));
            }
        };
        let is_to_cut = self.is_to_cut(described, &form, offset)?;
        if matches!(described.format, Some(Format::Clip))
            || described.rate.is_some()
            || described.start_s.is_some()
        {
            return Ok((file, self.clip_form(described, offset)?));
        }
        if described.has_text_keys() && !matches!(form, TableForm::Delimited(_)) {
            return Err(self.at(
                offset,
                "`decimal`, `thousands`, `comment`, `skip_lines` and `units_row` apply to CSV and TSV only",
            ));
        }
        let form = match (form, described.header, &described.rows) {
            (TableForm::Delimited(_), _, None) => {
                TableForm::Delimited(self.text_form(described, offset)?)
            }
            (TableForm::Json { .. }, None, rows) => TableForm::Json { rows: rows.clone() },
            (TableForm::Messages { .. }, None, rows) => TableForm::Messages {
                topic: rows.clone(),
                is_to_cut,
            },
            (
                TableForm::Arrays {
                    format, is_whole, ..
                },
                None,
                rows,
            ) => TableForm::Arrays {
                format,
                rows: rows.clone(),
                is_whole,
            },
            (form, None, None) => form,
            (_, Some(_), _) => return Err(self.at(offset, "`header` applies to CSV and TSV only")),
            (_, _, Some(_)) => {
                return Err(self.at(
                    offset,
                    "`rows` applies to JSON, files of arrays and recordings of messages only",
                ));
            }
        };
        Ok((file, form))
    }

    /// True if `cut` of the map asks for the complete messages of a truncated recording; false if truncation is an error.
    fn is_to_cut(
        &self,
        described: &WrittenForm,
        form: &TableForm,
        offset: usize,
    ) -> Result<bool, DatasetError> {
        let Some(cut) = described.cut.as_deref() else {
            return Ok(false);
        };
        match (form, cut) {
            (TableForm::Messages { .. }, "keep") => Ok(true),
            (TableForm::Messages { .. }, "refuse") => Ok(false),
            (TableForm::Messages { .. }, other) => Err(self.at(
                offset,
                &format!(
                    "`cut = {other:?}`, expected \"keep\", which reads the complete messages before the cut of a recording, or \"refuse\""
                ),
            )),
            _ => Err(self.at(
                offset,
                "`cut` applies to recordings of messages only (.mcap, .db3, .bag)",
            )),
        }
    }

    /// Checks the form of a clip as a table.
    fn clip_form(&self, described: &WrittenForm, offset: usize) -> Result<TableForm, DatasetError> {
        let rate = described.rate;
        let start_s = described.start_s.unwrap_or(0.0);
        match described.format {
            Some(Format::Clip)
                if rate.is_none_or(|rate| rate.is_finite() && rate > 0.0)
                    && start_s.is_finite()
                    && described.rows.is_none()
                    && described.header.is_none()
                    && !described.has_text_keys() =>
            {
                Ok(TableForm::Clip {
                    rate,
                    start_s,
                })
            }
            _ => Err(self.at(
                offset,
                "a table of the frames of a clip has `file`, `format = \"clip\"`, optionally `rate` (frames a second, above 0; by default \
                 the times that the clip states) and `start_s` (time of the first frame), and no other key",
            )),
        }
    }

    fn text_form(&self, described: &WrittenForm, offset: usize) -> Result<TextForm, DatasetError> {
        let decimal = match described.decimal.as_deref() {
            // With grouping points, the decimal mark is a comma.
            None if described.thousands.as_deref() == Some(".") => ',',
            None | Some(".") => '.',
            Some(",") => ',',
            Some(other) => {
                return Err(self.at(
                    offset,
                    &format!("`decimal = {other:?}`, expected \".\" or \",\""),
                ));
            }
        };
        let thousands = described.thousands.clone();
        if let Some(sign) = &thousands
            && (!["", ".", ",", "'", " ", "_", "\u{a0}", "\u{202f}"].contains(&sign.as_str())
                || *sign == decimal.to_string())
        {
            return Err(self.at(
                offset,
                &format!(
                    "`thousands = {sign:?}`, expected \".\", \",\", \"'\", \"_\", a blank, or \"\" where digits are not grouped; not the sign of `decimal`"
                ),
            ));
        }
        if described
            .comment
            .as_ref()
            .is_some_and(|comment| comment.trim().is_empty())
        {
            return Err(self.at(
                offset,
                "`comment` must be the text that begins a comment line, such as \"#\"",
            ));
        }
        Ok(TextForm {
            has_header: described.header.unwrap_or(true),
            decimal,
            thousands,
            comment: described.comment.clone(),
            skip_lines: described.skip_lines.unwrap_or_default(),
            has_units: described.units_row,
        })
    }
}

impl WrittenForm {
    fn has_text_keys(&self) -> bool {
        self.decimal.is_some()
            || self.thousands.is_some()
            || self.comment.is_some()
            || self.skip_lines.is_some()
            || self.units_row
    }
}
