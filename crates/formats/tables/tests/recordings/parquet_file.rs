//! Parquet files that tests write.

use std::path::PathBuf;
use std::sync::Arc;

use parquet::basic::Compression;
use parquet::column::writer::ColumnWriter;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

/// Writes a Parquet file of one column. `message` is the schema in the Parquet language. `write` fills the column.
pub(crate) fn parquet_file(
    message: &str,
    write: impl FnOnce(&mut ColumnWriter<'_>),
) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x.parquet");
    let schema = Arc::new(parse_message_type(message).expect("a schema"));
    let properties = WriterProperties::builder()
        .set_compression(Compression::UNCOMPRESSED)
        .build();
    let file = std::fs::File::create(&path).expect("created");
    let mut writer =
        SerializedFileWriter::new(file, schema, Arc::new(properties)).expect("a writer");
    let mut group = writer.next_row_group().expect("a group");
    let mut column = group.next_column().expect("a column").expect("one");
    write(column.untyped());
    column.close().expect("closed");
    group.close().expect("closed");
    writer.close().expect("closed");
    (folder, path)
}
