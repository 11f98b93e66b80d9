//! Seal of a model file: a digest over the card and over the digests of all tensors.

use safetensors::tensor::{Dtype, SafeTensors};
use sha2::{Digest as _, Sha256};

use crate::training::file::error::FormatError;

/// Name of a tensor, and the digest of its type, shape and values.
pub(super) fn digested(
    name: &str,
    kind: Dtype,
    shape: &[usize],
    bytes: &[u8],
) -> (String, Vec<u8>) {
    let mut hasher = Sha256::new();
    hasher.update(format!("{kind:?} {shape:?} ").as_bytes());
    hasher.update(bytes);
    (format!("tensor {name}"), hasher.finalize().to_vec())
}

/// Returns `card` with a seal over the card and the digests of `tensors`.
pub(super) fn seal_over(card: &str, tensors: &[(String, Vec<u8>)]) -> Result<String, FormatError> {
    let mut attached = attached(tensors);
    attached.sort_unstable();
    Ok(taceva_files::seal::json::seal_with(card, &attached)?)
}

fn attached(tensors: &[(String, Vec<u8>)]) -> Vec<(&str, &[u8])> {
    tensors
        .iter()
        .map(|(name, digest)| (name.as_str(), digest.as_slice()))
        .collect()
}

/// Checks that card and tensors are unchanged since they were written.
pub(super) fn check_seal(card: &str, tensors: &SafeTensors<'_>) -> Result<(), FormatError> {
    let views = tensors.tensors();
    let digested: Vec<_> = views
        .iter()
        .map(|(name, view)| digested(name, view.dtype(), view.shape(), view.data()))
        .collect();
    let mut attached = attached(&digested);
    attached.sort_unstable();
    taceva_files::seal::json::check_with(card, &attached)?;
    Ok(())
}
