//! Format version, metadata key and size limits of a model file.

/// Version of the model file format, `major.minor`.
pub(crate) const FORMAT: &str = "1.0";

/// Metadata key of the model card in a model file.
pub(crate) const CARD: &str = "taceva.model";

/// Maximum length of the header, in bytes. A model card takes a few kilobytes.
pub(crate) const HEADER_MAX: u64 = 1 << 20;

/// Maximum size of a model file, in bytes. Ten channels with weights for 1000 × 1000 RGB pixels take 240 MB.
pub(crate) const FILE_MAX: u64 = 1 << 28;
