//! Writer of signals, row by row. Keeps at most one row group in memory.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as PhysicalType};
use parquet::data_type::FloatType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::{SignalsInfo, SignalsSpec, rows_of_group};
use crate::decoder_panic::guarded;
use crate::digest::{Digest, PartsDigest};
use crate::error::DatasetError;
use crate::file::create_anew;

/// Signals file that is being written.
#[doc(hidden)]
pub struct SignalsWriter {
    path: PathBuf,
    spec: SignalsSpec,
    writer: SerializedFileWriter<BufWriter<File>>,
    /// Rows not yet written to a group, values taxel by taxel.
    held: Vec<f32>,
    rows: u64,
    digest: PartsDigest,
}

impl SignalsWriter {
    /// Creates the file at `path`, overwriting an existing file.
    pub fn create(path: &Path, spec: &SignalsSpec) -> Result<SignalsWriter, DatasetError> {
        let damaged = |problem| DatasetError::damaged(path, problem);
        spec.check().map_err(damaged)?;
        let file = create_anew(path)?;
        let writer = guarded(|| {
            let properties = Arc::new(properties(spec));
            SerializedFileWriter::new(BufWriter::new(file), schema(spec)?, properties)
        });
        let writer = writer.map_err(damaged)?;
        Ok(SignalsWriter {
            path: path.to_owned(),
            spec: spec.clone(),
            writer: writer.map_err(|error| damaged(error.to_string()))?,
            held: Vec::new(),
            rows: 0,
            digest: spec.digest(),
        })
    }

    /// Taxels of the file.
    pub fn spec(&self) -> &SignalsSpec {
        &self.spec
    }

    /// Adds the values of the next row.
    ///
    /// # Shapes
    /// `values`: rows × columns × channels, taxel by taxel.
    pub fn push(&mut self, values: &[f32]) -> Result<(), DatasetError> {
        let expected = self.spec.info.len();
        let row = self.rows;
        if values.len() != expected {
            let problem = format!("row {row}: {} signals, expected {expected}", values.len());
            return Err(DatasetError::damaged(&self.path, problem));
        }
        if let Some(position) = values.iter().position(|value| !value.is_finite()) {
            let problem = format!(
                "row {row}: signal {position} is {}, expected a finite number",
                values[position]
            );
            return Err(DatasetError::damaged(&self.path, problem));
        }
        for value in values {
            self.digest.fixed(&value.to_le_bytes());
        }
        self.held.extend_from_slice(values);
        self.rows += 1;
        match self.held.len() >= rows_of_group(expected) * expected {
            true => self.write_group(),
            false => Ok(()),
        }
    }

    /// Closes the file and syncs its content, but not its name.
    pub fn finish(mut self) -> Result<SignalsInfo, DatasetError> {
        let problem = self.spec.check_rest(self.rows);
        problem.map_err(|problem| DatasetError::damaged(&self.path, problem))?;
        if !self.held.is_empty() {
            self.write_group()?;
        }
        let SignalsWriter {
            path,
            spec,
            writer,
            mut digest,
            rows,
            ..
        } = self;
        let written = guarded(|| writer.into_inner());
        let written = written.map_err(|problem| DatasetError::damaged(&path, problem))?;
        let written = written.map_err(|error| DatasetError::damaged(&path, error.to_string()))?;
        let file = written.into_inner().map_err(|error| error.into_error());
        file.and_then(|file| file.sync_all())
            .map_err(DatasetError::io("write", &path))?;
        digest.fixed(&rows.to_le_bytes());
        let mut file = File::open(&path).map_err(DatasetError::io("open", &path))?;
        let sha256 = Digest::of_reader(&mut file).map_err(DatasetError::io("read", &path))?;
        Ok(SignalsInfo {
            spec,
            digest: digest.finish(),
            sha256,
        })
    }

    fn write_group(&mut self) -> Result<(), DatasetError> {
        let length = self.spec.info.len();
        let (writer, held) = (&mut self.writer, &self.held);
        let written = guarded(|| -> Result<(), ParquetError> {
            let mut group = writer.next_row_group()?;
            let mut column = Vec::with_capacity(held.len() / length);
            for position in 0..length {
                column.clear();
                column.extend(held.iter().skip(position).step_by(length));
                let next = group.next_column()?;
                let mut next =
                    next.ok_or_else(|| ParquetError::General("fewer columns".to_owned()))?;
                next.typed::<FloatType>().write_batch(&column, None, None)?;
                next.close()?;
            }
            group.close()?;
            Ok(())
        });
        self.held.clear();
        let written = written.map_err(|problem| DatasetError::damaged(&self.path, problem))?;
        written.map_err(|error| DatasetError::damaged(&self.path, error.to_string()))
    }
}

impl std::fmt::Debug for SignalsWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SignalsWriter")
            .field("path", &self.path)
            .field("spec", &self.spec)
            .field("rows", &self.rows)
            .finish_non_exhaustive()
    }
}

fn schema(spec: &SignalsSpec) -> Result<Arc<Type>, ParquetError> {
    let field = |name: String| {
        Type::primitive_type_builder(&name, PhysicalType::FLOAT)
            .with_repetition(Repetition::REQUIRED)
            .build()
            .map(Arc::new)
    };
    let fields = spec.column_names().map(field);
    let schema = Type::group_type_builder("signals").with_fields(fields.collect::<Result<_, _>>()?);
    Ok(Arc::new(schema.build()?))
}

fn properties(spec: &SignalsSpec) -> WriterProperties {
    let unit = spec.info.unit.symbol().to_owned();
    WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::None)
        .set_created_by("taceva".to_owned())
        .set_key_value_metadata(Some(vec![KeyValue::new("unit".to_owned(), unit)]))
        .build()
}
