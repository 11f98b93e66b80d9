//! Text form of SHA-256 digests.

use sha2::{Digest as _, Sha256};

pub(crate) const PREFIX: &str = "sha256:";

/// Formats `digest` as `sha256:` and lower-case hexadecimal digits.
pub(crate) fn text_of(digest: &[u8]) -> String {
    format!("{PREFIX}{}", hexadecimal(digest))
}

pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// SHA-256 of `bytes`, as `sha256:` and 64 hexadecimal digits.
pub fn digest_of_bytes(bytes: &[u8]) -> String {
    text_of(&Sha256::digest(bytes))
}
