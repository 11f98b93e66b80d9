//! Child process: confines itself, then decodes the packets that its parent sends.

use std::io::{self, Read, Write};

use super::rav1d::{Decoder, Refused};
use super::sandbox::confine;
use super::wire::{Answer, Greeting, Unit, plane_bytes};

/// Reason why a child ends before its parent closes the input.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    /// Reading from or writing to the parent failed, or the parent is another program.
    #[error("the AV1 decoder cannot communicate with its parent process: {0}")]
    Parent(#[from] io::Error),
    /// The process could not be confined. Nothing was decoded.
    #[error("the AV1 decoder cannot be confined: {0}")]
    Confinement(String),
    /// The decoder could not be created.
    #[error("the AV1 decoder does not start: error {0}")]
    Start(i32),
}

/// Decodes AV1 for a parent that writes to `input` and reads from `output`, until the parent closes `input`.
///
/// Confines the whole process permanently before it decodes the first byte of a clip. On Linux the process can then open no file or connection and
/// start no process. Memory is limited to frames of the size that the parent states. The confinement needs seccomp filters on x86-64 or 64-bit ARM.
/// On other systems the process keeps its rights. Call this function last in a separate command.
///
/// # Errors
/// [`ServeError`]. The parent detects the exit of the child. A panic in the decoder ends the process.
///
/// ```no_run
/// // The whole of a program that `Decoders::av1` may name.
/// let (input, output) = (std::io::stdin().lock(), std::io::stdout().lock());
/// taceva_video::av1::serve(input, output)?;
/// # Ok::<(), taceva_video::av1::ServeError>(())
/// ```
pub fn serve(mut input: impl Read, mut output: impl Write) -> Result<(), ServeError> {
    let size = Greeting::read(&mut input)?;
    confine(memory_bytes(size)).map_err(ServeError::Confinement)?;
    let pixels = size.width.saturating_mul(size.height);
    let mut decoder = Decoder::open(pixels).map_err(ServeError::Start)?;
    while let Some(unit) = Unit::read(&mut input)? {
        if unit.is_restart {
            decoder = Decoder::open(pixels).map_err(ServeError::Start)?;
        }
        let answer = match decoder.decode(&unit.bytes, unit.is_wanted) {
            Ok(answer) => answer,
            Err(Refused::Code(code)) => Answer::Refused(format!("error {code}")),
            Err(Refused::Kind(kind)) => Answer::Refused(kind.to_owned()),
        };
        answer.write(&mut output)?;
        output.flush()?;
    }
    Ok(())
}

/// Memory limit of the decoder, bytes: the program itself, the frames that a codec keeps, and the side data of these frames.
fn memory_bytes(size: Greeting) -> u64 {
    (512 << 20) + 48 * plane_bytes(size.width, size.height, false)
}
