//! Decoder of the bytes from an interface box: numbered frames of six values, and lines that answer commands. No I/O.

/// One message from an interface box.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Message {
    /// Frame with one force reading.
    Reading(Reading),
    /// Answer to a command, without the line end.
    Line(String),
}

/// Force reading of six values, before the conversion to N and N·mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    /// Sequence number, increased by one per frame, wrapping after 65535.
    pub(super) number: u16,
    /// Forces Fx, Fy, Fz and torques Mx, My, Mz, in the units of the box; may contain NaN.
    pub(super) values: [f32; 6],
}

/// Splits bytes that arrive in pieces of any size into messages, and resynchronises after lost bytes.
#[derive(Debug, Default)]
pub(super) struct Messages {
    waiting: Vec<u8>,
    /// True directly after a complete message, where the next message must begin.
    is_in_place: bool,
    /// Number of bytes skipped because they belong to no message.
    lost: u64,
}

const MARK: [u8; 2] = [0xaa, 0x55];
/// Size of the six values in a frame, bytes.
const DATA: usize = 24;
/// Size of the head of a frame, bytes: start mark, length field and frame number.
const HEAD: usize = 6;
/// Supported checksums. The length of a frame identifies the checksum.
const CHECKS: [Check; 2] = [Check::Sum, Check::Crc32];

/// Checksum after the values of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Check {
    /// Sum of the bytes, modulo 256. The sum does not detect swapped bytes.
    Sum,
    /// CRC-32 with the polynomial of zlib, little-endian.
    Crc32,
}

impl Check {
    /// Size of the checksum, bytes.
    const fn length(self) -> usize {
        match self {
            Check::Sum => 1,
            Check::Crc32 => 4,
        }
    }

    /// Size of a complete frame with one reading, bytes.
    const fn frame(self) -> usize {
        HEAD + DATA + self.length()
    }

    /// Length field of a frame with this checksum. The length includes frame number, values and checksum.
    fn stated(self) -> [u8; 2] {
        let length = u16::try_from(self.frame() - 4).expect("a length of two bytes");
        length.to_be_bytes()
    }

    /// True if `check` is the checksum of `data`.
    fn holds(self, data: &[u8], check: &[u8]) -> bool {
        match self {
            Check::Sum => check == [data.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte))],
            Check::Crc32 => check == crc32fast::hash(data).to_le_bytes(),
        }
    }
}
/// Prefix of answers to commands.
const ANSWER: &[u8] = b"ACK+";
/// Maximum length of an answer line, bytes.
const LINE_MAX: usize = 512;

/// Content at the beginning of received bytes.
enum Start {
    /// A complete message and its length in bytes.
    Whole(Message, usize),
    /// The beginning of a message whose other bytes have not arrived.
    Unfinished,
    /// Bytes that begin no message.
    Foreign,
}

impl Messages {
    /// Appends received bytes.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
    }

    /// Number of bytes skipped so far because they belong to no message.
    pub(super) fn lost(&self) -> u64 {
        self.lost
    }

    /// Returns the next complete message; `None` until it has arrived.
    pub(super) fn next(&mut self) -> Option<Message> {
        let mut at = 0;
        let found = loop {
            match start_of(&self.waiting[at..]) {
                Start::Whole(message, length) if self.is_trusted(&message, at + length) => {
                    at += length;
                    self.is_in_place = true;
                    break Some(message);
                }
                // Two frames are needed, and the second has not arrived.
                Start::Whole(_, length) if self.waiting.len() < at + 2 * length => break None,
                Start::Unfinished => break None,
                Start::Whole(..) | Start::Foreign => {
                    self.is_in_place = false;
                    self.lost += 1;
                    at += 1;
                }
            }
        };
        self.waiting.drain(..at);
        found
    }

    /// True if `message`, which ends at byte `end` of the buffer, can be trusted. Bytes of values may look like a frame by chance. Before
    /// synchronisation, a frame is trusted only if an answer or the frame with the next number follows.
    fn is_trusted(&self, message: &Message, end: usize) -> bool {
        let Message::Reading(reading) = message else {
            return true;
        };
        if self.is_in_place {
            return true;
        }
        match start_of(&self.waiting[end..]) {
            Start::Whole(Message::Reading(next), _) => {
                next.number == reading.number.wrapping_add(1)
            }
            Start::Whole(Message::Line(_), _) => true,
            Start::Unfinished | Start::Foreign => false,
        }
    }
}

fn start_of(bytes: &[u8]) -> Start {
    if bytes.is_empty() {
        return Start::Unfinished;
    }
    if begins(bytes, ANSWER) {
        return match bytes
            .windows(2)
            .take(LINE_MAX)
            .position(|end| end == b"\r\n")
        {
            Some(length) => {
                let text = String::from_utf8_lossy(&bytes[..length]).into_owned();
                Start::Whole(Message::Line(text), length + 2)
            }
            None if bytes.len() < LINE_MAX => Start::Unfinished,
            None => Start::Foreign,
        };
    }
    let fits = |check: &Check| {
        let [high, low] = check.stated();
        begins(bytes, &[MARK[0], MARK[1], high, low])
    };
    let Some(check) = CHECKS.into_iter().find(fits) else {
        return Start::Foreign;
    };
    let Some(frame) = bytes.get(..check.frame()) else {
        return Start::Unfinished;
    };
    let (data, behind) = frame[HEAD..].split_at(DATA);
    if !check.holds(data, behind) {
        return Start::Foreign;
    }
    let values = std::array::from_fn(|index| {
        let at = 4 * index;
        f32::from_le_bytes([data[at], data[at + 1], data[at + 2], data[at + 3]])
    });
    let number = u16::from_be_bytes([frame[4], frame[5]]);
    Start::Whole(Message::Reading(Reading { number, values }), frame.len())
}

/// True if `bytes` and `head` are equal up to the shorter length.
fn begins(bytes: &[u8], head: &[u8]) -> bool {
    let length = bytes.len().min(head.len());
    bytes[..length] == head[..length]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::hexadecimal;

    /// Example frame in the manual of the box, in hexadecimal.
    const GOLDEN: &str = "AA55 001B C4C7 016AF4C0 EF7D33C0 4962C9C0 A25CC6BD A6198FBD AFDA693E 6E";

    fn frame(number: u16, values: [f32; 6]) -> Vec<u8> {
        let data: Vec<u8> = values.into_iter().flat_map(f32::to_le_bytes).collect();
        let sum = data.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        let head = [0xaa, 0x55, 0x00, 0x1b];
        [&head[..], &number.to_be_bytes()[..], &data[..], &[sum][..]].concat()
    }

    /// Frame with `number`, `values` and a CRC-32 of four bytes.
    fn frame_crc32(number: u16, values: [f32; 6]) -> Vec<u8> {
        let mut frame = frame(number, values);
        frame.pop();
        frame[3] = 0x1e;
        let check = crc32fast::hash(&frame[6..]).to_le_bytes();
        [&frame[..], &check[..]].concat()
    }

    #[test]
    fn frames_with_crc32_are_read_beside_those_with_a_sum_and_two_bytes_that_changed_places_are_noticed()
     {
        // Published check value of this CRC.
        assert!(Check::Crc32.holds(b"123456789", &[0x26, 0x39, 0xf4, 0xcb]));
        let whole = [
            frame_crc32(8, [1.0; 6]),
            frame_crc32(9, [2.0; 6]),
            frame(10, [3.0; 6]),
        ]
        .concat();
        for piece in [1, 5, whole.len()] {
            let mut messages = Messages::default();
            let mut found = Vec::new();
            for part in whole.chunks(piece) {
                messages.push(part);
                found.extend(numbers(&all(&mut messages)));
            }
            assert_eq!(found, [8, 9, 10], "in pieces of {piece}");
        }
        let mut swapped = frame_crc32(11, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        swapped.swap(8, 16);
        let mut messages = Messages::default();
        messages.push(&[frame_crc32(10, [0.0; 6]), frame_crc32(11, [0.0; 6])].concat());
        messages.push(
            &[
                swapped,
                frame_crc32(12, [0.0; 6]),
                frame_crc32(13, [0.0; 6]),
            ]
            .concat(),
        );
        assert_eq!(numbers(&all(&mut messages)), [10, 11, 12, 13]);
    }

    fn all(messages: &mut Messages) -> Vec<Message> {
        std::iter::from_fn(|| messages.next()).collect()
    }

    fn numbers(found: &[Message]) -> Vec<u16> {
        found
            .iter()
            .filter_map(|message| match message {
                Message::Reading(reading) => Some(reading.number),
                Message::Line(_) => None,
            })
            .collect()
    }

    #[test]
    fn the_frame_of_the_manual_is_read_as_the_manual_reads_it() {
        let mut messages = Messages::default();
        messages.push(&hexadecimal(GOLDEN));
        assert_eq!(messages.next(), None, "one frame alone is not trusted yet");
        messages.push(&frame(0xc4c8, [0.0; 6]));
        let Some(Message::Reading(reading)) = messages.next() else {
            panic!("a reading")
        };
        assert_eq!(reading.number, 50_375);
        let expected = [
            -7.637_94, -2.804_561, -6.293_248, -0.096_856, -0.069_873, 0.228_373,
        ];
        for (found, expected) in reading.values.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found}, {expected}");
        }
    }

    #[test]
    fn frames_and_answers_are_the_same_however_they_are_split_and_merged() {
        let stream = [
            frame(1, [1.0; 6]),
            frame(2, [2.0; 6]),
            b"ACK+SMPF=200$OK\r\n".to_vec(),
            frame(3, [3.0; 6]),
            frame(65_535, [4.0; 6]),
            frame(0, [5.0; 6]),
        ]
        .concat();
        for piece in 1..=stream.len() {
            let mut messages = Messages::default();
            let mut found = Vec::new();
            for part in stream.chunks(piece) {
                messages.push(part);
                found.extend(all(&mut messages));
            }
            assert_eq!(
                numbers(&found),
                [1, 2, 3, 65_535, 0],
                "in pieces of {piece}"
            );
            assert_eq!(found[2], Message::Line("ACK+SMPF=200$OK".to_owned()));
            assert_eq!(messages.lost(), 0);
        }
    }

    /// Values whose bytes contain a complete frame head.
    fn treacherous() -> [f32; 6] {
        let head = f32::from_le_bytes([0xaa, 0x55, 0x00, 0x1b]);
        [head, 0.5, head, -0.5, head, 0.25]
    }

    #[test]
    fn a_mark_within_the_numbers_moves_nothing() {
        let stream: Vec<u8> = (10..20)
            .flat_map(|number| frame(number, treacherous()))
            .collect();
        for cut in 0..31 {
            let mut messages = Messages::default();
            messages.push(&stream[cut..]);
            let found = numbers(&all(&mut messages));
            let first = if cut == 0 { 10 } else { 11 };
            assert_eq!(found, (first..20).collect::<Vec<u16>>(), "from byte {cut}");
        }
    }

    #[test]
    fn a_damaged_frame_is_lost_alone_and_the_place_is_found_again() {
        let mut stream: Vec<u8> = (0..6)
            .flat_map(|number| frame(number, treacherous()))
            .collect();
        stream[2 * Check::Sum.frame() + 9] ^= 0x10;
        let mut messages = Messages::default();
        messages.push(&stream);
        assert_eq!(numbers(&all(&mut messages)), [0, 1, 3, 4, 5]);
        assert_eq!(messages.lost(), 31);
        // Bytes between two frames, and a truncated frame.
        let torn = [
            frame(6, [0.0; 6]),
            b"noise".to_vec(),
            frame(7, [0.0; 6])[..20].to_vec(),
            frame(8, [0.0; 6]),
            frame(9, [0.0; 6]),
        ]
        .concat();
        messages.push(&torn);
        assert_eq!(numbers(&all(&mut messages)), [6, 8, 9]);
    }

    #[test]
    fn absurd_lengths_endless_lines_and_noise_keep_nothing_waiting() {
        let mut messages = Messages::default();
        messages.push(&hexadecimal("AA55 FFFF 0001"));
        messages.push(&hexadecimal("AA55 0000 0001"));
        messages.push(&[0xaa; 100]);
        messages.push(b"ACK+");
        messages.push(&[b'x'; 2 * LINE_MAX]);
        messages.push(&[0x55; 100]);
        assert_eq!(messages.next(), None);
        assert!(
            messages.waiting.len() < Check::Crc32.frame(),
            "{}",
            messages.waiting.len()
        );
        messages.push(&[frame(4, [1.0; 6]), frame(5, [1.0; 6])].concat());
        assert_eq!(numbers(&all(&mut messages)), [4, 5]);
    }

    #[test]
    fn numbers_that_are_none_are_handed_on_for_the_driver_to_refuse() {
        let mut messages = Messages::default();
        let spoilt = [f32::NAN, f32::INFINITY, 0.0, 0.0, 0.0, 0.0];
        messages.push(&[frame(0, spoilt), frame(1, spoilt)].concat());
        let Some(Message::Reading(reading)) = messages.next() else {
            panic!("a reading")
        };
        assert!(reading.values[0].is_nan() && reading.values[1].is_infinite());
    }
}
