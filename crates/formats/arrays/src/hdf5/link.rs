//! Error messages for names that are links to another file or within the same file.
//!
//! Groups in the newer format store their links as messages (format specification of HDF5 3.0, IV.A.2.g), which `hdf5-pure` skips. After a name was not found,
//! the bytes of the file are searched for these messages.

use crate::error::Problem;
use crate::source::{ByteSource, FileBytes, bytes_of};

/// Type number of a soft link. `EXTERNAL` is that of an external link.
const SOFT: u8 = 1;
const EXTERNAL: u8 = 64;
/// Number of bytes at the start of a file that are searched. `BLOCK` is the size of a block searched at once, bytes.
const FURTHEST: u64 = 64 << 20;
const BLOCK: u64 = 1 << 20;
/// Maximum length of a supported link message, bytes.
const MESSAGE: u64 = 2 << 10;

/// Error for `name` if its last part is a link; `None` otherwise.
pub(super) fn of(file: &FileBytes, name: &str) -> Option<Problem> {
    let leaf = name.rsplit('/').next().filter(|leaf| !leaf.is_empty())?;
    let length = u8::try_from(leaf.len()).ok()?;
    let wanted = [&[length], leaf.as_bytes()].concat();
    let end = file.length().min(FURTHEST);
    let mut at = 0;
    while at < end {
        let bytes = bytes_of(file, at, (BLOCK + MESSAGE).min(end - at)).ok()?;
        let mut places = bytes.windows(wanted.len()).enumerate();
        let found = places.find_map(|(place, window)| {
            (window == wanted).then(|| message(&bytes, place, wanted.len()))?
        });
        if let Some((kind, value)) = found {
            return Some(problem(name, kind, &value));
        }
        at += BLOCK;
    }
    None
}

/// Type and value of the link message whose name length is stored at the offset `place`; `None` for other bytes.
fn message(bytes: &[u8], place: usize, length: usize) -> Option<(u8, Vec<u8>)> {
    // Before the name: version 1, flags, the type, and by the flags the creation order and the character set.
    let is_head = |before: usize| {
        let at = place.checked_sub(before)?;
        let flags = bytes[at + 1];
        let order = if flags & 4 == 0 { 0 } else { 8 };
        let letters = usize::from(flags & 16 != 0);
        let kind = bytes[at + 2];
        let is_whole = bytes[at] == 1 && flags & 11 == 8 && before == 3 + order + letters;
        (is_whole && matches!(kind, SOFT | EXTERNAL)).then_some(kind)
    };
    let kind = [3, 4, 11, 12].into_iter().find_map(is_head)?;
    let behind = bytes.get(place + length..)?;
    let count = usize::from(u16::from_le_bytes([*behind.first()?, *behind.get(1)?]));
    Some((kind, behind.get(2..2 + count)?.to_vec()))
}

fn problem(name: &str, kind: u8, value: &[u8]) -> Problem {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match kind {
        SOFT => Problem::unsupported(
            format!("`{name}` is a soft link to `{}`", text(value)),
            format!("request `{}` directly", text(value)),
        ),
        _ => {
            let mut parts = value.get(1..).unwrap_or(&[]).split(|byte| *byte == 0);
            let file = text(parts.next().unwrap_or(&[]));
            let inside = text(parts.next().unwrap_or(&[]));
            Problem::unsupported(
                format!(
                    "`{name}` is a link to `{inside}` of another file, `{file}`, which is not followed"
                ),
                format!(
                    "name that file, or copy the array into this file: `with h5py.File(path, 'a') as f: a = f['{name}'][()]; del \
                     f['{name}']; f['{name}'] = a`"
                ),
            )
        }
    }
}
