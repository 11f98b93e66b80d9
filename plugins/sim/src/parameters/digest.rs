//! Digest of a parameter set, 32 bytes.

use std::fmt;

use sha2::{Digest, Sha256};

use super::section::Entry;

/// SHA-256 of the canonical form of a parameter set: its name, then one line for each value, ordered by section and key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ParameterDigest([u8; 32]);

impl ParameterDigest {
    pub(super) fn of(name: &str, entries: &[Entry]) -> ParameterDigest {
        let mut hash = Sha256::new();
        hash.update(format!("name {name}\n"));
        for entry in entries {
            let Entry {
                section,
                key,
                value,
                unit,
                origin,
                ..
            } = entry;
            // The bits identify the value without rounding.
            let bits = value.to_bits();
            hash.update(format!("{section}.{key} {bits:016x} {unit} {origin}\n"));
        }
        ParameterDigest(hash.finalize().into())
    }

    /// Bytes of the digest.
    pub fn as_bytes(&self) -> &[u8; 32] {
        &self.0
    }
}

impl fmt::Display for ParameterDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}
