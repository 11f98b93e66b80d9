//! Certificate of an instrument in a rig file. Errors name the line of the certificate's key.

use std::collections::BTreeMap;

use taceva_core::{Certificate, Instrument};
use toml::{Spanned, Value};

use super::Check;
use crate::text::{SceneError, Setting};

/// Entries of a certificate as written.
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
        let at_table = written.at();
        let (mut places, mut entries) = (BTreeMap::new(), BTreeMap::new());
        for (key, value) in written.value {
            places.insert(key.get_ref().clone(), key.span().start);
            entries.insert(key.into_inner(), value);
        }
        match Certificate::of_entries::<Value, toml::de::Error>(of, &entries) {
            Ok(certificate) => Ok(Some(certificate)),
            Err(error) => {
                let at_key = error.key().and_then(|key| places.get(key).copied());
                self.refuse(at_key.or(at_table), format!("[{of}.certificate]: {error}"))
            }
        }
    }
}
