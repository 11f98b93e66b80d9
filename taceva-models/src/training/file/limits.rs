//! Identification and size limits of a model file.

/// Version of the file format.
pub(crate) const FORMAT: &str = "1.0";

/// Key of the card in the metadata.
pub(crate) const CARD: &str = "taceva.model";

/// Maximum length of the header. A card has a few kilobytes.
pub(crate) const HEADER_MAX: u64 = 1 << 20;

/// Maximum size of a file. 1000 × 1000 RGB weights of ten channels are 240 MB.
pub(crate) const FILE_MAX: u64 = 1 << 28;
