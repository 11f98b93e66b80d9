//! Certificate of an instrument in a rig file. Errors name the line of the certificate's key.

use std::collections::BTreeMap;

use taceva_core::{Certificate, Instrument};
use toml::{Spanned, Value};

use super::Check;
use crate::text::{SceneError, Setting};

/// Entries of a `certificate` table, as the rig file states them.
pub(super) type WrittenCertificate = Setting<BTreeMap<Spanned<String>, Value>>;

impl Check<'_> {
    pub(super) fn certificate(
        &self,
        of: Instrument,
        written: Option<WrittenCertificate>,
    ) -> Result<Option<Certificate>, SceneError> {
        let Some(written) = written else {
            return Ok(None);
        };
        match Certificate::of_entries::<_, Value, toml::de::Error>(of, &written.value) {
            Ok(certificate) => Ok(Some(certificate)),
            Err(error) => {
                let entry = error.key().and_then(|key| written.value.get_key_value(key));
                let at_key = entry.map(|(key, _)| key.span().start);
                let at = at_key.or_else(|| written.at());
                self.refuse(at, format!("[{of}.certificate]: {error}"))
            }
        }
    }
}
