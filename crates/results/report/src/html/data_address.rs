//! Files embedded in a page.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

/// `data:` URL of a file.
pub(crate) fn address(media_type: &str, bytes: &[u8]) -> String {
    format!("data:{media_type};base64,{}", BASE64_STANDARD.encode(bytes))
}
