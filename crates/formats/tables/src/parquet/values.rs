//! Encodings of the values of a Parquet column, and checks that a stated number of values fits into the bytes of a page.

use parquet::basic::{Encoding, Type as Physical};
use parquet::schema::types::ColumnDescriptor;

/// Minimum size of a value in the encoding `PLAIN`, bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct ValueSize(u64);

impl ValueSize {
    pub(super) fn of(column: &ColumnDescriptor) -> ValueSize {
        ValueSize(match column.physical_type() {
            Physical::BOOLEAN => 1,
            Physical::INT32 | Physical::FLOAT => 32,
            Physical::INT64 | Physical::DOUBLE => 64,
            Physical::INT96 => 96,
            // Length before the bytes.
            Physical::BYTE_ARRAY => 32,
            Physical::FIXED_LEN_BYTE_ARRAY => u64::try_from(column.type_length()).unwrap_or(0) * 8,
        })
    }

    /// Checks that a dictionary of `values` values fits into its `bytes` bytes, because memory is allocated for the stated number.
    pub(super) fn check_dictionary(self, values: u32, bytes: usize) -> Result<(), String> {
        match self.0 {
            1 => Err("the dictionary has booleans, expected numbers or bytes".to_owned()),
            bits => ValueSize(bits.max(8)).check_plain(values, bytes),
        }
    }

    /// Checks that `values` values in the encoding `PLAIN` fit into `bytes` bytes.
    pub(super) fn check_plain(self, values: u32, bytes: usize) -> Result<(), String> {
        let bits = u64::from(values).checked_mul(self.0);
        match bits.is_some_and(|bits| bits <= (bytes as u64).saturating_mul(8)) {
            true => Ok(()),
            false => Err(format!(
                "a page of {bytes} bytes cannot hold {values} values"
            )),
        }
    }
}

pub(super) fn encoding(code: i32) -> Result<Encoding, String> {
    Ok(match code {
        0 => Encoding::PLAIN,
        2 => Encoding::PLAIN_DICTIONARY,
        3 => Encoding::RLE,
        #[expect(deprecated, reason = "older writers use this encoding of levels")]
        4 => Encoding::BIT_PACKED,
        5 => Encoding::DELTA_BINARY_PACKED,
        6 => Encoding::DELTA_LENGTH_BYTE_ARRAY,
        7 => Encoding::DELTA_BYTE_ARRAY,
        8 => Encoding::RLE_DICTIONARY,
        9 => Encoding::BYTE_STREAM_SPLIT,
        other => return Err(format!("values in encoding {other}, expected 0 to 9")),
    })
}

/// Encoding of levels with the number `code`. If a page has no levels, writers state any number, so all are accepted.
pub(super) fn level_encoding(code: i32, are_there: bool) -> Result<Encoding, String> {
    match (code, are_there) {
        (3 | 4, _) => encoding(code),
        (_, false) => Ok(Encoding::RLE),
        (other, true) => Err(format!("levels in encoding {other}, expected 3 or 4")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_values_than_bytes_can_hold_are_refused() {
        assert_eq!(ValueSize(32).check_plain(3, 12), Ok(()));
        assert_eq!(
            ValueSize(32).check_plain(3, 11),
            Err("a page of 11 bytes cannot hold 3 values".to_owned())
        );
        assert_eq!(ValueSize(1).check_plain(16, 2), Ok(()));
        assert!(ValueSize(0).check_dictionary(u32::MAX, 100).is_err());
        assert!(ValueSize(1).check_dictionary(1, 100).is_err());
    }
}
