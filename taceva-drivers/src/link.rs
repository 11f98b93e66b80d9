//! What drivers over TCP have in common: connecting within a deadline, the errors of a link, and the clock that stamps what comes.

mod connect;
mod error;
mod mailbox;
mod monotonic;

pub(crate) use connect::connect;
pub(crate) use error::LinkError;
pub(crate) use mailbox::{Ending, Mailbox, NoNews, Seen};
pub(crate) use monotonic::monotonic;

/// The bytes that `text` writes in hexadecimal, white space between them.
#[cfg(test)]
pub(crate) fn hexadecimal(text: &str) -> Vec<u8> {
    let digits: Vec<u32> = text
        .chars()
        .filter_map(|digit| digit.to_digit(16))
        .collect();
    let byte = |pair: &[u32]| u8::try_from(16 * pair[0] + pair[1]).expect("two digits");
    digits.chunks_exact(2).map(byte).collect()
}
