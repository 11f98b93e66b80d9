//! The child: confines itself, then decodes what it is sent.

use std::io::{self, Read, Write};

use super::rav1d::{Decoder, Refused};
use super::sandbox::confine;
use super::wire::{Answer, Greeting, Unit, plane_bytes};

/// Why a child ended before its parent did.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServeError {
    /// The parent could not be read from or written to, or is another program.
    #[error("the parent of the decoder of AV1: {0}")]
    Parent(#[from] io::Error),
    /// The process could not be confined; nothing was decoded.
    #[error("the decoder of AV1 cannot be confined: {0}")]
    Confinement(String),
    /// The decoder could not be made.
    #[error("the decoder of AV1 does not start: error {0}")]
    Start(i32),
}

/// Decodes AV1 for a parent that writes to `input` and reads from `output`, until it closes `input`.
///
/// The whole process is confined for good before the first byte of a clip is decoded. On Linux it can then open no file, make no connection,
/// start no process, and use no more memory than frames of that size take; that needs seccomp filters, on x86-64 or a 64-bit ARM. On other
/// systems the process keeps its rights. It is the program's last act: call it from a command of its own.
///
/// # Errors
/// [`ServeError`]; the parent sees the child end. A panic in the decoder ends the process.
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

/// What decoding such frames may take: the program itself, and the frames that a codec keeps with what it knows of each.
fn memory_bytes(size: Greeting) -> u64 {
    (512 << 20) + 48 * plane_bytes(size.width, size.height, false)
}
