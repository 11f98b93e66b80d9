//! Canonical form of a JSON value, from which a digest independent of formatting is computed.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use sha2::{Digest as _, Sha256};

/// JSON value whose digest ignores key order, spaces and number format. Parsing rejects duplicate keys.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Canonical {
    Null,
    Bool(bool),
    /// Whole number; `2.0` and `2` are equal.
    Whole(i128),
    /// Number that is not whole, as the bits of its `f64`.
    Real(u64),
    Text(String),
    List(Vec<Canonical>),
    Object(BTreeMap<String, Canonical>),
}

impl Canonical {
    pub(crate) fn parse(text: &str) -> Result<Canonical, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    pub(crate) fn digest(&self) -> [u8; 32] {
        let mut hasher = Sha256::new();
        self.add_to(&mut hasher);
        hasher.finalize().into()
    }

    /// Adds the value to `hasher`, prefixed with its kind and, if needed, its length. The encoding is therefore unambiguous.
    fn add_to(&self, hasher: &mut Sha256) {
        match self {
            Canonical::Null => hasher.update(b"n"),
            Canonical::Bool(value) => hasher.update([b'b', u8::from(*value)]),
            Canonical::Whole(number) => {
                hasher.update(b"i");
                hasher.update(number.to_le_bytes());
            }
            Canonical::Real(bits) => {
                hasher.update(b"r");
                hasher.update(bits.to_le_bytes());
            }
            Canonical::Text(text) => add_text(b"t", text, hasher),
            Canonical::List(items) => {
                hasher.update(b"l");
                hasher.update((items.len() as u64).to_le_bytes());
                items.iter().for_each(|item| item.add_to(hasher));
            }
            Canonical::Object(entries) => {
                hasher.update(b"o");
                hasher.update((entries.len() as u64).to_le_bytes());
                for (key, value) in entries {
                    add_text(b"k", key, hasher);
                    value.add_to(hasher);
                }
            }
        }
    }
}

fn add_text(kind: &[u8], text: &str, hasher: &mut Sha256) {
    hasher.update(kind);
    hasher.update((text.len() as u64).to_le_bytes());
    hasher.update(text.as_bytes());
}

impl<'de> Deserialize<'de> for Canonical {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Canonical, D::Error> {
        deserializer.deserialize_any(Reader)
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Canonical;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E>(self) -> Result<Canonical, E> {
        Ok(Canonical::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Canonical, E> {
        Ok(Canonical::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Canonical, E> {
        Ok(Canonical::Whole(value.into()))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Canonical, E> {
        Ok(Canonical::Whole(value.into()))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Canonical, E> {
        // A larger float may represent several integers.
        let is_whole = value.fract().to_bits() << 1 == 0 && value.abs() < 9_007_199_254_740_992.0;
        #[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        let whole = value as i128;
        Ok(match is_whole {
            true => Canonical::Whole(whole),
            false => Canonical::Real(value.to_bits()),
        })
    }

    fn visit_str<E>(self, value: &str) -> Result<Canonical, E> {
        Ok(Canonical::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Canonical, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            list.push(item);
        }
        Ok(Canonical::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Canonical, A::Error> {
        let mut object = BTreeMap::new();
        while let Some((key, value)) = entries.next_entry::<String, Canonical>()? {
            if let Some(_twice) = object.insert(key.clone(), value) {
                let key = key.escape_debug();
                return Err(de::Error::custom(format!("duplicate key `{key}`")));
            }
        }
        Ok(Canonical::Object(object))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_a_value_is_written_plays_no_part_and_what_it_says_does() {
        let digest = |text: &str| Canonical::parse(text).expect("JSON").digest();
        let same = digest(r#"{"a":[1,2.5],"b":"x"}"#);
        assert_eq!(
            digest("{ \"b\" : \"\\u0078\",\n \"a\":[1.0, 25e-1] }"),
            same
        );
        for other in [
            r#"{"a":[1,2.5],"b":"y"}"#,
            r#"{"a":[1,2.25],"b":"x"}"#,
            r#"{"a":[12.5],"b":"x"}"#,
            r#"{"a":[1,2.5],"b":"x","c":null}"#,
            r#"{"a":[1,2.5],"c":"x"}"#,
        ] {
            assert_ne!(digest(other), same, "{other}");
        }
    }

    #[test]
    fn a_key_that_is_written_twice_is_refused() {
        let error = Canonical::parse(r#"{"a":1,"a":2}"#).expect_err("twice");
        assert!(error.contains("duplicate key `a`"), "{error}");
    }

    #[test]
    fn whole_numbers_beyond_doubles_differ() {
        let digest = |text: &str| Canonical::parse(text).expect("JSON").digest();
        assert_ne!(digest("9007199254740993"), digest("9007199254740992"));
    }
}
