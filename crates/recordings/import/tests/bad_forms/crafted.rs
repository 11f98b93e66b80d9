//! Tests of files that are crafted to harm their reader.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

/// NumPy file of version 1.
pub(super) fn npy(kind: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let length = u16::try_from(header.len()).expect("short");
    let head = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    [&head, header.as_bytes(), data].concat()
}

/// Archive with one deflated member `value.npy` that declares a size of `size` bytes.
pub(super) fn archive_of_zeros(size: u64, zeros: &[u8]) -> Vec<u8> {
    let member = npy("<f8", &format!("({},)", size / 8), zeros);
    let packed = miniz_oxide::deflate::compress_to_vec(&member, 6);
    let (length, name) = (packed.len() as u64, b"value.npy");
    // 64-bit sizes are in an extra field.
    let extra = [
        &[1, 0, 16, 0][..],
        &size.to_le_bytes(),
        &length.to_le_bytes(),
    ]
    .concat();
    let head = |version: &[u8]| {
        let begin = [version, &[45, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0]].concat();
        let lengths = [9_u16.to_le_bytes(), 20_u16.to_le_bytes()].concat();
        [&begin[..], &[0xff; 8], &lengths].concat()
    };
    let local = [&head(b"PK\x03\x04")[..], name, &extra, &packed].concat();
    let entry = [&head(b"PK\x01\x02\x2d\x00")[..], &[0; 14], name, &extra].concat();
    let number = |count: usize| u32::try_from(count).expect("small").to_le_bytes();
    let end = [
        &b"PK\x05\x06\0\0\0\0\x01\0\x01\0"[..],
        &number(entry.len()),
        &number(local.len()),
        &[0, 0],
    ]
    .concat();
    [local, entry, end].concat()
}

/// Table of half a million texts of 10 kB, all the same dictionary entry, beside numbers.
pub(super) fn bomb_of_parquet(path: &Path) {
    const ROWS: usize = 500_000;
    let schema = "message x { required double value; required binary text (UTF8); }";
    let schema = parse_message_type(schema).expect("a schema");
    let properties = Arc::new(WriterProperties::builder().build());
    let file = File::create(path).expect("made");
    let mut writer =
        SerializedFileWriter::new(file, Arc::new(schema), properties).expect("a writer");
    let mut group = writer.next_row_group().expect("a group");
    while let Some(mut column) = group.next_column().expect("a column") {
        match column.untyped() {
            ColumnWriter::DoubleColumnWriter(column) => {
                column
                    .write_batch(&vec![1.0; ROWS], None, None)
                    .expect("written");
            }
            ColumnWriter::ByteArrayColumnWriter(column) => {
                let text = ByteArray::from(vec![b'x'; 10_000]);
                for _ in 0..5 {
                    let batch = vec![text.clone(); ROWS / 5];
                    column.write_batch(&batch, None, None).expect("written");
                }
            }
            _ => unreachable!("the schema has no other"),
        }
        column.close().expect("closed");
    }
    group.close().expect("closed");
    writer.close().expect("closed");
}
