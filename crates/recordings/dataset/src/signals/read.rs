//! Reader of signals. Verifies the file once, then caches a few row groups.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use parquet::column::reader::ColumnReader;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use taceva_core::Signals;

use super::{GROUP_VALUES, SignalsInfo};
use crate::decoder_panic::guarded;
use crate::digest::Digest;
use crate::error::DatasetError;

/// Maximum number of cached row groups, which take 64 MiB.
const GROUPS: usize = 16;

/// A verified file of signals, shared between threads.
#[doc(hidden)]
pub struct SignalsReader {
    path: PathBuf,
    info: SignalsInfo,
    file: SerializedFileReader<File>,
    /// First row of each group, then the total number of rows.
    starts: Vec<u64>,
    /// Recently used groups, the newest last, with values taxel by taxel.
    groups: Mutex<VecDeque<(usize, Arc<Vec<f32>>)>>,
}

impl SignalsReader {
    /// Opens the signals of `rows` samples in `file`, which is at `path` and must match `info`.
    pub fn open(
        path: &Path,
        mut file: File,
        info: &SignalsInfo,
        rows: u64,
    ) -> Result<SignalsReader, DatasetError> {
        let found = Digest::of_reader(&mut file).map_err(DatasetError::io("read", path))?;
        if found != info.sha256 {
            return Err(DatasetError::digest(path, info.sha256, found));
        }
        file.seek(SeekFrom::Start(0))
            .map_err(DatasetError::io("read", path))?;
        let damaged = |problem| DatasetError::damaged(path, problem);
        let opened = guarded(|| SerializedFileReader::new(file)).map_err(damaged)?;
        let file = opened.map_err(|error| damaged(error.to_string()))?;
        let starts = starts(&file, info, rows).map_err(damaged)?;
        info.spec.check_rest(rows).map_err(damaged)?;
        Ok(SignalsReader {
            path: path.to_owned(),
            info: info.clone(),
            file,
            starts,
            groups: Mutex::default(),
        })
    }

    /// Signals of row `row`.
    pub fn row(&self, row: usize) -> Result<Signals, DatasetError> {
        let at = self.starts.partition_point(|start| *start <= row as u64);
        let number = at.saturating_sub(1);
        let group = self.group(number)?;
        let length = self.info.spec.info.len();
        let first = row.saturating_sub(usize::try_from(self.starts[number]).unwrap_or(usize::MAX));
        let values = first
            .checked_mul(length)
            .and_then(|first| group.get(first..first.checked_add(length)?))
            .ok_or_else(|| DatasetError::damaged(&self.path, format!("no row {row}")))?;
        let signals = Signals::new(self.info.spec.info, values.to_vec());
        signals.map_err(|error| DatasetError::damaged(&self.path, format!("row {row}: {error}")))
    }

    /// Reads every row and checks the content digest.
    pub fn verify(&self) -> Result<(), DatasetError> {
        let mut digest = self.info.spec.digest();
        for number in 0..self.starts.len() - 1 {
            for value in self.group(number)?.iter() {
                digest.fixed(&value.to_le_bytes());
            }
        }
        digest.fixed(&self.starts[self.starts.len() - 1].to_le_bytes());
        let found = digest.finish();
        match found == self.info.digest {
            true => Ok(()),
            false => Err(DatasetError::digest(&self.path, self.info.digest, found)),
        }
    }

    /// Values of a row group, cached or read now. Concurrent requests for one group read it once.
    fn group(&self, number: usize) -> Result<Arc<Vec<f32>>, DatasetError> {
        let mut groups = self.groups.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(position) = groups.iter().position(|(kept, _)| *kept == number) {
            // The newest last.
            let found = groups.remove(position).expect("a position of it");
            groups.push_back(found.clone());
            return Ok(found.1);
        }
        let read = guarded(|| {
            let group = self.file.get_row_group(number)?;
            read_group(&*group, self.info.spec.info.len())
        });
        let read = read.map_err(|problem| DatasetError::damaged(&self.path, problem))?;
        let read = read.map_err(|error| DatasetError::damaged(&self.path, error.to_string()))?;
        let read = Arc::new(read);
        if groups.len() >= GROUPS {
            groups.pop_front();
        }
        groups.push_back((number, Arc::clone(&read)));
        Ok(read)
    }
}

impl std::fmt::Debug for SignalsReader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SignalsReader")
            .field("path", &self.path)
            .field("info", &self.info)
            .finish_non_exhaustive()
    }
}

/// First row of each group. Checks schema and sizes against `info` before memory of these sizes is allocated.
fn starts(
    file: &SerializedFileReader<File>,
    info: &SignalsInfo,
    rows: u64,
) -> Result<Vec<u64>, String> {
    let metadata = file.metadata();
    let schema = metadata.file_metadata().schema_descr();
    let columns = schema.columns().iter();
    let names = columns.clone().map(|column| column.name());
    let is_flat = columns
        .clone()
        .all(|column| column.max_def_level() == 0 && column.max_rep_level() == 0);
    if !is_flat || !names.eq(info.spec.column_names()) {
        return Err("its columns differ from the columns in the header".to_owned());
    }
    let length = info.spec.info.len();
    let mut starts = vec![0];
    let mut sum = 0_u64;
    for group in metadata.row_groups() {
        let own = u64::try_from(group.num_rows()).map_err(|_| "a negative number of rows")?;
        let values = own.checked_mul(length as u64);
        if values.is_none_or(|values| values > GROUP_VALUES as u64) || own == 0 {
            return Err(format!(
                "a row group of {own} rows of {length} numbers, expected 1 to {GROUP_VALUES} numbers"
            ));
        }
        sum = sum.saturating_add(own);
        starts.push(sum);
    }
    match sum == rows {
        true => Ok(starts),
        false => Err(format!(
            "{sum} rows of signals, expected {rows} by the header"
        )),
    }
}

/// Values of a row group, taxel by taxel.
fn read_group(group: &dyn RowGroupReader, length: usize) -> Result<Vec<f32>, ParquetError> {
    let rows = usize::try_from(group.metadata().num_rows())?;
    let mut values = vec![0.0; rows * length];
    let mut column = Vec::with_capacity(rows);
    for position in 0..length {
        column.clear();
        let ColumnReader::FloatColumnReader(mut reader) = group.get_column_reader(position)? else {
            return Err(ParquetError::General(
                "a column has another type, expected FLOAT".to_owned(),
            ));
        };
        while column.len() < rows {
            let (records, _, _) =
                reader.read_records(rows - column.len(), None, None, &mut column)?;
            if records == 0 {
                return Err(ParquetError::General(
                    "columns of different lengths".to_owned(),
                ));
            }
        }
        let places = values.iter_mut().skip(position).step_by(length);
        places
            .zip(&column)
            .for_each(|(place, value)| *place = *value);
    }
    Ok(values)
}
