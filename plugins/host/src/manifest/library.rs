//! Library files by platform.

use std::fmt;
use std::path::{Component, Path};

use serde::{Deserialize, Serialize};

/// Platforms that a manifest may name.
pub(super) const PLATFORMS: [&str; 9] = [
    "linux-x86_64",
    "linux-aarch64",
    "linux-arm",
    "linux-riscv64",
    "macos-x86_64",
    "macos-aarch64",
    "windows-x86_64",
    "windows-aarch64",
    "freebsd-x86_64",
];

/// Platform of this program, as manifests write it: `linux-x86_64`.
pub fn platform() -> String {
    format!("{}-{}", std::env::consts::OS, std::env::consts::ARCH)
}

/// Library file of one platform.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LibraryFile {
    /// Path relative to the manifest, below its folder.
    pub path: String,
    /// Required digest; `None` if any build is accepted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sha256: Option<Sha256Digest>,
}

/// Describes the fault of a library path; `None` if it is valid.
pub(crate) fn path_fault(path: &str) -> Option<&'static str> {
    if path.is_empty() || path.contains(char::is_control) {
        return Some("expected the name of a file");
    }
    let mut parts = Path::new(path).components();
    if parts.any(|part| !matches!(part, Component::Normal(_))) {
        return Some("expected a path relative to the manifest, without `..`");
    }
    None
}

/// A SHA-256 digest.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Sha256Digest(pub [u8; 32]);

impl Sha256Digest {
    /// Parses 64 hexadecimal digits; `None` for any other text.
    pub fn from_hex(text: &str) -> Option<Sha256Digest> {
        let digits = text.as_bytes();
        if digits.len() != 64 || !digits.iter().all(u8::is_ascii_hexdigit) {
            return None;
        }
        let mut bytes = [0; 32];
        for (byte, pair) in bytes.iter_mut().zip(text.as_bytes().chunks_exact(2)) {
            let pair = std::str::from_utf8(pair).ok()?;
            *byte = u8::from_str_radix(pair, 16).ok()?;
        }
        Some(Sha256Digest(bytes))
    }
}

impl TryFrom<String> for Sha256Digest {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Sha256Digest, &'static str> {
        Sha256Digest::from_hex(&text).ok_or("expected 64 hexadecimal digits")
    }
}

impl From<Sha256Digest> for String {
    fn from(digest: Sha256Digest) -> String {
        digest.to_string()
    }
}

impl fmt::Display for Sha256Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Sha256Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_reads_back_as_it_is_written() {
        let text = "00ff".repeat(16);
        let digest = Sha256Digest::from_hex(&text).expect("64 digits");
        assert_eq!(digest.to_string(), text);
        assert_eq!(Sha256Digest::from_hex(&text.to_uppercase()), Some(digest));
        for bad in [
            "",
            "00",
            &"0g".repeat(32),
            &"00".repeat(33),
            &"é".repeat(32),
        ] {
            assert_eq!(Sha256Digest::from_hex(bad), None, "{bad}");
        }
    }

    #[test]
    fn a_path_stays_below_its_folder() {
        for good in ["libx.so", "lib/libx.so"] {
            assert_eq!(path_fault(good), None, "{good}");
        }
        for bad in [
            "",
            "..",
            "../x.so",
            "a/../../x.so",
            "/x.so",
            "./x.so",
            "a\0b",
        ] {
            assert!(path_fault(bad).is_some(), "{bad}");
        }
    }

    #[test]
    fn this_platform_is_one_that_a_manifest_may_name() {
        assert!(PLATFORMS.contains(&platform().as_str()), "{}", platform());
    }
}
