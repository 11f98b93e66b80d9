//! Messages of the real-time data exchange, big-endian. No I/O.

use thiserror::Error;

use crate::text::shown;

/// Message type of the request for a protocol version. The next constants are the other types.
pub(super) const VERSION: u8 = b'V';
pub(super) const OUTPUTS: u8 = b'O';
pub(super) const START: u8 = b'S';
pub(super) const CONTROLLER: u8 = b'v';
const DATA: u8 = b'U';
const TEXT: u8 = b'M';

/// Version of the data exchange that this driver requests.
const PROTOCOL: u16 = 2;
/// Output that the driver requests from the controller.
struct Output {
    name: &'static str,
    kind: &'static str,
    /// First controller versions with this output, for CB3 and e-Series, as documented. Empty if every version has it.
    since: &'static str,
}

const fn output(name: &'static str, kind: &'static str, since: &'static str) -> Output {
    Output { name, kind, since }
}

/// Requested outputs, in the order of a data message. A stop program writes its number to the last output, an integer register.
static ASKED: [Output; 7] = [
    output("timestamp", "DOUBLE", ""),
    output("actual_TCP_pose", "VECTOR6D", ""),
    output("robot_mode", "INT32", ""),
    output("safety_status_bits", "UINT32", "3.10 and 5.4"),
    output("runtime_state", "UINT32", ""),
    output("target_speed_fraction", "DOUBLE", ""),
    output("output_int_register_24", "INT32", "3.9 and 5.3"),
];
/// Text that the controller sends instead of a type for an unknown output.
const NOT_FOUND: &str = "NOT_FOUND";
/// Integer register to which a stop program writes its number.
pub(super) const STOP_REGISTER: u8 = 24;
/// Size of a data message without its header, bytes: recipe number, then outputs.
const DATA_LENGTH: usize = 1 + 8 + 48 + 4 + 4 + 4 + 8 + 4;
/// Maximum length of a message, bytes.
const LENGTH_MAX: usize = 4096;
/// Size of a message header, bytes: length and type.
const HEADER: usize = 3;

/// State of an arm at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArmState {
    /// Pose of the tool in the base frame: x, y, z in m and a rotation vector in rad; may contain NaN.
    pub(super) pose: [f64; 6],
    pub(super) robot_mode: i32,
    pub(super) safety: u32,
    pub(super) runtime: u32,
    /// Position of the speed slider of the pendant, 0 to 1; may be NaN.
    pub(super) slider: f64,
    /// Number of the last stop that the controller began.
    pub(super) stop: i32,
}

/// Message from the controller.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Message {
    /// Answer to the request with this message type; true if the request is accepted.
    Accepted(u8, bool),
    /// Types of the requested outputs, separated by commas.
    Types(String),
    /// Version of the controller: major, minor, bug fix, build; `None` if the controller does not state its version.
    Controller(Option<[u32; 4]>),
    State(ArmState),
    /// Text for people, which the driver ignores.
    Text,
}

impl Message {
    /// True if this message answers a request of type `request`.
    pub(super) fn answers(&self, request: u8) -> bool {
        match self {
            Message::Accepted(of, _) => *of == request,
            Message::Types(_) => request == OUTPUTS,
            Message::Controller(_) => request == CONTROLLER,
            Message::State(_) | Message::Text => false,
        }
    }
}

/// Error for an invalid message: the stream has lost synchronisation.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum MessageError {
    #[error("a message of {found} bytes, expected {HEADER} to {LENGTH_MAX}")]
    Length { found: usize },
    #[error("an unexpected message of kind {kind:#04x} and {length} bytes")]
    Kind { kind: u8, length: usize },
    #[error("outputs of types `{}`, expected `{}`", shown(.found), kinds())]
    Types { found: String },
}

/// Types of all requested outputs, separated by commas.
fn kinds() -> String {
    joined(|output| output.kind)
}

/// Texts that `word` returns for the requested outputs, separated by commas.
fn joined(word: fn(&Output) -> &'static str) -> String {
    let words: Vec<&str> = ASKED.iter().map(word).collect();
    words.join(",")
}

/// Encodes the request for the protocol version.
pub(super) fn ask_version() -> Vec<u8> {
    message(VERSION, &PROTOCOL.to_be_bytes())
}

/// Encodes the request for the version of the controller.
pub(super) fn ask_controller() -> Vec<u8> {
    message(CONTROLLER, &[])
}

/// Encodes the request for the outputs, `rate_hz` times per second.
pub(super) fn ask_outputs(rate_hz: f64) -> Vec<u8> {
    let names = joined(|output| output.name);
    message(
        OUTPUTS,
        &[&rate_hz.to_be_bytes()[..], names.as_bytes()].concat(),
    )
}

/// Encodes the request to start sending states.
pub(super) fn ask_start() -> Vec<u8> {
    message(START, &[])
}

fn message(kind: u8, says: &[u8]) -> Vec<u8> {
    let length = u16::try_from(HEADER + says.len()).unwrap_or(u16::MAX);
    [&length.to_be_bytes()[..], &[kind], says].concat()
}

/// Requested outputs that the controller lacks, each with the first versions that have it. `found` is the answer of the controller: one type for each
/// output.
///
/// # Errors
/// [`MessageError::Types`] if the other outputs do not have the expected types.
pub(super) fn missing_outputs(found: &str) -> Result<Vec<String>, MessageError> {
    let types: Vec<&str> = found.split(',').collect();
    let is_answer = |(output, kind): (&Output, &&str)| [output.kind, NOT_FOUND].contains(kind);
    if types.len() != ASKED.len() || !ASKED.iter().zip(&types).all(is_answer) {
        return Err(MessageError::Types {
            found: found.to_owned(),
        });
    }
    let missing = ASKED
        .iter()
        .zip(types)
        .filter(|(_, kind)| *kind == NOT_FOUND);
    let named = missing.map(|(Output { name, since, .. }, _)| match *since {
        "" => format!("`{name}`"),
        since => format!("`{name}` (since {since})"),
    });
    Ok(named.collect())
}

/// Splits bytes that arrive in pieces of any size into messages.
#[derive(Debug, Default)]
pub(super) struct Messages {
    waiting: Vec<u8>,
}

impl Messages {
    /// Appends received bytes.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
    }

    /// Returns the next complete message; `None` until it has arrived.
    ///
    /// # Errors
    /// [`MessageError`], which is permanent: the link must be closed.
    pub(super) fn next(&mut self) -> Result<Option<Message>, MessageError> {
        let Some(&[high, low, kind]) = self.waiting.first_chunk::<HEADER>() else {
            return Ok(None);
        };
        let length = usize::from(u16::from_be_bytes([high, low]));
        if !(HEADER..=LENGTH_MAX).contains(&length) {
            return Err(MessageError::Length { found: length });
        }
        if self.waiting.len() < length {
            return Ok(None);
        }
        let says = &self.waiting[HEADER..length];
        let message = match (kind, says) {
            (VERSION | START, [accepted]) => Message::Accepted(kind, *accepted == 1),
            (CONTROLLER, says) => Message::Controller(version(says)),
            // Recipe number, then the types.
            (OUTPUTS, [_, types @ ..]) => {
                Message::Types(String::from_utf8_lossy(types).into_owned())
            }
            (DATA, says) if says.len() == DATA_LENGTH => Message::State(state(&says[1..])),
            (TEXT, _) => Message::Text,
            _ => return Err(MessageError::Kind { kind, length }),
        };
        self.waiting.drain(..length);
        Ok(Some(message))
    }
}

/// Decodes a controller version of four big-endian numbers; `None` unless `says` has 16 bytes.
fn version(says: &[u8]) -> Option<[u32; 4]> {
    let says = <[u8; 16]>::try_from(says).ok()?;
    let number = |at: usize| u32::from_be_bytes(std::array::from_fn(|byte| says[4 * at + byte]));
    Some(std::array::from_fn(number))
}

fn state(says: &[u8]) -> ArmState {
    let double = |at: usize| {
        let bytes: [u8; 8] = std::array::from_fn(|byte| says[at + byte]);
        f64::from_be_bytes(bytes)
    };
    let word = |at: usize| u32::from_be_bytes(std::array::from_fn(|byte| says[at + byte]));
    ArmState {
        // After 8 bytes of time since power-on.
        pose: std::array::from_fn(|side| double(8 + 8 * side)),
        robot_mode: word(56).cast_signed(),
        safety: word(60),
        runtime: word(64),
        slider: double(68),
        stop: word(76).cast_signed(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::hexadecimal;

    /// Data message of an arm at (0.3, 0, 0.25) m.
    fn data() -> Vec<u8> {
        let mut says = vec![1];
        for number in [12.5, 0.3, 0.0, 0.25, 0.0, 3.125, 0.0] {
            says.extend_from_slice(&f64::to_be_bytes(number));
        }
        says.extend_from_slice(&hexadecimal("00000007 00000001 00000002"));
        says.extend_from_slice(&f64::to_be_bytes(0.5));
        says.extend_from_slice(&hexadecimal("0000002a"));
        message(DATA, &says)
    }

    #[test]
    fn requests_are_in_network_order() {
        assert_eq!(ask_version(), hexadecimal("0005 56 0002"));
        assert_eq!(ask_start(), hexadecimal("0003 53"));
        assert_eq!(ask_controller(), hexadecimal("0003 76"));
        let outputs = ask_outputs(125.0);
        assert_eq!(outputs[..11], hexadecimal("007d 4f 405f400000000000"));
        assert_eq!(outputs.len(), 0x7d);
    }

    #[test]
    fn messages_are_the_same_however_they_are_split_and_merged() {
        let kinds = kinds();
        let types = message(OUTPUTS, &[&[1], kinds.as_bytes()].concat());
        let stream = [
            hexadecimal("0004 56 01"),
            types,
            hexadecimal("0005 4d 6869"),
            hexadecimal("0004 53 01"),
            data(),
            data(),
        ]
        .concat();
        for piece in 1..stream.len() {
            let mut messages = Messages::default();
            let mut found = Vec::new();
            for part in stream.chunks(piece) {
                messages.push(part);
                while let Some(message) = messages.next().expect("good messages") {
                    found.push(message);
                }
            }
            assert_eq!(found.len(), 6, "in pieces of {piece}");
            assert_eq!(found[0], Message::Accepted(VERSION, true));
            assert_eq!(found[1], Message::Types(kinds.clone()));
            let Message::State(state) = found[5] else {
                panic!("a state")
            };
            assert_eq!(
                state.pose.map(f64::to_bits),
                [0.3, 0.0, 0.25, 0.0, 3.125, 0.0].map(f64::to_bits)
            );
            let words = (state.robot_mode, state.safety, state.runtime, state.stop);
            assert_eq!(words, (7, 1, 2, 42));
            assert_eq!(state.slider.to_bits(), 0.5_f64.to_bits());
        }
    }

    #[test]
    fn foreign_bytes_end_the_stream() {
        for (bytes, expected) in [
            ("0000 55", MessageError::Length { found: 0 }),
            ("ffff 55", MessageError::Length { found: 0xffff }),
            (
                "0004 55 01",
                MessageError::Kind {
                    kind: 0x55,
                    length: 4,
                },
            ),
            (
                "0003 56",
                MessageError::Kind {
                    kind: 0x56,
                    length: 3,
                },
            ),
            (
                "0004 7a 00",
                MessageError::Kind {
                    kind: 0x7a,
                    length: 4,
                },
            ),
        ] {
            let mut messages = Messages::default();
            messages.push(&hexadecimal(bytes));
            assert_eq!(messages.next(), Err(expected));
        }
        assert!(missing_outputs("DOUBLE,NOT_FOUND").is_err());
    }

    #[test]
    fn a_missing_output_is_named_with_the_versions_that_have_it() {
        let all = "DOUBLE,VECTOR6D,INT32,UINT32,UINT32,DOUBLE,INT32";
        assert_eq!(missing_outputs(all), Ok(Vec::new()));
        let without = "DOUBLE,VECTOR6D,INT32,NOT_FOUND,UINT32,DOUBLE,NOT_FOUND";
        let expected = [
            "`safety_status_bits` (since 3.10 and 5.4)",
            "`output_int_register_24` (since 3.9 and 5.3)",
        ];
        let missing = missing_outputs(without).expect("an answer");
        assert_eq!(missing, expected);
        let other = all.replace("VECTOR6D", "VECTOR3D");
        assert!(missing_outputs(&other).is_err());
    }

    #[test]
    fn the_version_of_the_controller_is_four_numbers() {
        let mut messages = Messages::default();
        messages.push(&hexadecimal("0013 76 00000005 0000000b 00000000 0001a6d9"));
        let found = messages.next().expect("a message");
        assert_eq!(found, Some(Message::Controller(Some([5, 11, 0, 108_249]))));
        messages.push(&hexadecimal("0004 76 00"));
        let refused = messages.next().expect("a message");
        assert_eq!(refused, Some(Message::Controller(None)));
    }
}
