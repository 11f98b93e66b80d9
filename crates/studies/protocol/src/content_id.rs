//! Ids computed from content. Equal contents have equal ids on every machine and in every version.

use std::fmt;

/// Id of a press or a plan: a 128-bit hash of its content, written as 32 hexadecimal digits.
///
/// The hash is FNV-1a. Accidental collisions are negligible, but deliberate collisions are possible.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ContentId(u128);

impl fmt::Display for ContentId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl fmt::Debug for ContentId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl ContentId {
    /// Id of a text.
    pub fn of_text(text: &str) -> ContentId {
        Hasher::new("taceva.text/1").text(text).finish()
    }

    /// Parses 32 hexadecimal digits; `None` for other text.
    pub fn from_hex(text: &str) -> Option<ContentId> {
        let is_hex = text.len() == 32 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let bits = u128::from_str_radix(text, 16).ok()?;
        is_hex.then_some(ContentId(bits))
    }
}

impl serde::Serialize for ContentId {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Hash in progress. Every value gets a length prefix or a fixed width, so different contents give different bytes.
#[derive(Clone, Debug)]
pub(crate) struct Hasher(u128);

impl Hasher {
    /// Starts a hash of data with the schema `schema`, a name with a version.
    pub(crate) fn new(schema: &str) -> Hasher {
        Hasher(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d).text(schema)
    }

    pub(crate) fn text(self, text: &str) -> Hasher {
        self.count(text.len()).bytes(text.as_bytes())
    }

    pub(crate) fn whole(self, number: i64) -> Hasher {
        self.bytes(&number.to_le_bytes())
    }

    pub(crate) fn count(self, count: usize) -> Hasher {
        self.bytes(&(count as u64).to_le_bytes())
    }

    /// Adds a number by its bits. Numbers are converted from whole nanometres, so −0 does not occur.
    pub(crate) fn number(self, number: f64) -> Hasher {
        self.bytes(&number.to_bits().to_le_bytes())
    }

    pub(crate) fn finish(self) -> ContentId {
        ContentId(self.0)
    }

    fn bytes(self, bytes: &[u8]) -> Hasher {
        const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
        Hasher(bytes.iter().fold(self.0, |hash, byte| {
            (hash ^ u128::from(*byte)).wrapping_mul(PRIME)
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_that_of_the_reference() {
        // Test vector of the FNV reference for the text "a".
        let empty = Hasher(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        assert_eq!(
            empty.bytes(b"a").finish().to_string(),
            "d228cb696f1a8caf78912b704e4a8964"
        );
    }

    #[test]
    fn texts_that_join_to_one_have_two_digests() {
        let pair = |one, other| Hasher::new("t").text(one).text(other).finish();
        assert_ne!(pair("ab", "c"), pair("a", "bc"));
    }

    #[test]
    fn a_digest_reads_back_from_what_it_prints() {
        let digest = Hasher::new("t").whole(-1).finish();
        assert_eq!(ContentId::from_hex(&digest.to_string()), Some(digest));
        for text in ["", "+1", "zz", &"f".repeat(33)] {
            assert_eq!(ContentId::from_hex(text), None, "{text}");
        }
    }
}
