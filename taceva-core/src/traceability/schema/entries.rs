//! Reads a certificate from the entries of its table in a file. Errors name the key.

use std::borrow::Borrow;
use std::collections::BTreeMap;
use std::fmt::Display;

use serde::de::value::MapDeserializer;
use serde::de::{Deserialize, Error, IntoDeserializer};

use super::{DateText, WrittenCertificate, WrittenCorrelation};
use crate::traceability::{Certificate, CertificateError, Instrument};

/// Type of a key's value.
#[derive(Clone, Copy)]
enum Kind {
    Text,
    Day,
    Number,
    Amounts,
    Shares,
    Ranges,
    Correlations,
}

/// Keys of a certificate, required keys first.
static KEYS: [(&str, Kind); 16] = [
    ("number", Kind::Text),
    ("laboratory", Kind::Text),
    ("issued", Kind::Day),
    ("serial", Kind::Text),
    ("accreditation", Kind::Text),
    ("valid_until", Kind::Day),
    ("k", Kind::Number),
    ("p", Kind::Number),
    ("dof", Kind::Number),
    ("U", Kind::Amounts),
    ("U_relative", Kind::Shares),
    ("range", Kind::Ranges),
    ("correlation", Kind::Correlations),
    ("temperature", Kind::Text),
    ("file", Kind::Text),
    ("sha256", Kind::Text),
];
/// Number of required keys at the beginning of [`KEYS`].
const REQUIRED: usize = 4;

impl Kind {
    const fn expected(self) -> &'static str {
        match self {
            Kind::Text => "a string in quotes",
            Kind::Day => "a day such as 2026-05-12",
            Kind::Number => "a number such as 2.0",
            Kind::Amounts => "amounts by channel, such as { Fz = \"3.0 mN\" }",
            Kind::Shares => "numbers by channel, such as { Fz = 0.001 }",
            Kind::Ranges => "two amounts by channel, such as { Fz = [\"0.05 N\", \"50 N\"] }",
            Kind::Correlations => "a list such as [[\"Fx\", \"Fy\", 0.0]]",
        }
    }

    /// True if `value` has this type.
    fn reads<'de, V, E>(self, value: V) -> bool
    where
        V: IntoDeserializer<'de, E>,
        E: Error,
    {
        let value = value.into_deserializer();
        match self {
            Kind::Text => String::deserialize(value).is_ok(),
            Kind::Day => DateText::deserialize(value).is_ok(),
            Kind::Number => f64::deserialize(value).is_ok(),
            Kind::Amounts => BTreeMap::<String, String>::deserialize(value).is_ok(),
            Kind::Shares => BTreeMap::<String, f64>::deserialize(value).is_ok(),
            Kind::Ranges => BTreeMap::<String, [String; 2]>::deserialize(value).is_ok(),
            Kind::Correlations => Vec::<WrittenCorrelation>::deserialize(value).is_ok(),
        }
    }
}

impl Certificate {
    /// Reads the certificate of `instrument` from the entries of its table in a file.
    ///
    /// # Errors
    /// [`CertificateError`] for an unknown key, missing keys, a value of another type, or entries that [`check`](Certificate::check) rejects.
    pub fn of_entries<'de, K, V, E>(
        instrument: Instrument,
        entries: &BTreeMap<K, V>,
    ) -> Result<Certificate, CertificateError>
    where
        K: Borrow<str> + Ord,
        V: IntoDeserializer<'de, E> + Clone + Display,
        E: Error,
    {
        for (key, value) in entries {
            let key: &str = key.borrow();
            let Some((_, kind)) = KEYS.iter().find(|(known, _)| *known == key) else {
                return Err(CertificateError::UnknownKey {
                    key: key.to_owned(),
                    known: KEYS.iter().map(|(known, _)| *known).collect(),
                });
            };
            if !kind.reads::<V, E>(value.clone()) {
                let found = value.to_string();
                return Err(CertificateError::value(key, found, kind.expected()));
            }
        }
        let is_missing = |key: &str| !entries.contains_key(key);
        let required = KEYS.iter().take(REQUIRED).map(|(key, _)| *key);
        let mut missing: Vec<&str> = required.filter(|key| is_missing(key)).collect();
        if !missing.is_empty() {
            // One key of each pair is required. A missing pair is a separate error if no other key is missing.
            let either = [("k", "p"), ("U", "U_relative")].into_iter();
            let either = either.filter(|(one, other)| is_missing(one) && is_missing(other));
            missing.extend(either.map(|(one, _)| one));
            return Err(CertificateError::MissingKeys(missing));
        }
        let pairs = entries.iter().map(|(key, value)| {
            let key: &str = key.borrow();
            (key, value.clone())
        });
        let pairs = MapDeserializer::<'de, _, E>::new(pairs);
        let written = WrittenCertificate::deserialize(pairs).map_err(|error| {
            CertificateError::value("certificate", "a table", error.to_string())
        })?;
        let certificate = Certificate::try_from(written)?;
        certificate.check(instrument)?;
        Ok(certificate)
    }
}
