//! Encoding of requests and decoding of records of the Net F/T raw data transfer (RDT), big-endian. No I/O.

use super::status::Status;

/// Request to a Net F/T box about its stream of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Request {
    /// Stop sending records.
    Stop,
    /// Send records until stopped.
    Start,
}

impl Request {
    /// Encodes the request.
    pub(super) fn bytes(self) -> [u8; 8] {
        let command = match self {
            Request::Stop => 0,
            Request::Start => 2,
        };
        let endless = [0; 4];
        let [c0, c1, c2, c3] = endless;
        [0x12, 0x34, 0x00, command, c0, c1, c2, c3]
    }
}

/// One reading of the transducer, in raw counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Record {
    /// Sequence number, increased by one per record sent.
    pub(super) number: u32,
    pub(super) status: Status,
    /// Raw values of Fx, Fy, Fz, Tx, Ty and Tz, counts.
    pub(super) counts: [i32; 6],
}

/// Size of a record, bytes.
pub(super) const RECORD: usize = 36;

impl Record {
    /// Parses the records of a datagram. The result is empty if the datagram length is not a multiple of [`RECORD`].
    pub(super) fn all(datagram: &[u8]) -> Vec<Record> {
        let records = datagram.chunks_exact(RECORD);
        if !records.remainder().is_empty() {
            return Vec::new();
        }
        records.map(Record::read).collect()
    }

    fn read(bytes: &[u8]) -> Record {
        let word = |index: usize| {
            let at = 4 * index;
            u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
        };
        Record {
            number: word(0),
            status: Status(word(2)),
            counts: std::array::from_fn(|axis| word(3 + axis).cast_signed()),
        }
    }
}

/// Sequence number `record` minus sequence number `than`, with wrap-around. Negative if `record` is older.
pub(super) fn later_by(record: u32, than: u32) -> i32 {
    record.wrapping_sub(than).cast_signed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::hexadecimal;

    #[test]
    fn requests_are_those_of_the_public_client() {
        assert_eq!(
            Request::Start.bytes().to_vec(),
            hexadecimal("1234 0002 00000000")
        );
        assert_eq!(
            Request::Stop.bytes().to_vec(),
            hexadecimal("1234 0000 00000000")
        );
    }

    #[test]
    fn a_record_is_read_in_network_order_and_a_torn_one_is_none() {
        let record = hexadecimal(
            "00000007 00000070 80020000 0016e360 ffddaaf0 ff676980 00000001 ffffffff 7fffffff",
        );
        let [found] = Record::all(&record)[..] else {
            panic!("one record")
        };
        assert_eq!(found.number, 7);
        assert_eq!(
            found.counts,
            [1_500_000, -2_250_000, -10_000_000, 1, -1, i32::MAX]
        );
        assert!(found.status.is_saturated() && found.status.has_error());
        assert_eq!(Record::all(&[&record[..], &record[..]].concat()).len(), 2);
        for length in [0, 1, 35, 37, 71] {
            let torn: Vec<u8> = record.iter().cycle().take(length).copied().collect();
            assert!(Record::all(&torn).is_empty(), "{length} bytes");
        }
    }

    #[test]
    fn numbers_of_records_go_round() {
        assert_eq!(later_by(5, 3), 2);
        assert_eq!(later_by(3, 5), -2);
        assert_eq!(later_by(1, u32::MAX), 2);
    }
}
