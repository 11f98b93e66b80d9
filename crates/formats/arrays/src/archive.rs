//! Directory of a zip archive: the members and the locations of their bytes.
//!
//! Members are stored or deflated. Archives above 4 GiB (zip64) are supported. Each local header is compared with the directory.

use crate::error::Problem;
use crate::inflate::Wrapping;
use crate::limits;
use crate::member_bytes::Packed;
use crate::scalar::shown;
use crate::source::{ByteSource, bytes_of};

const END: u32 = 0x0605_4b50;
const END_64: u32 = 0x0606_4b50;
const END_64_LOCATOR: u32 = 0x0706_4b50;
const ENTRY: u32 = 0x0201_4b50;
const LOCAL: u32 = 0x0403_4b50;
/// Length of the end record of a zip archive without its comment, bytes.
const END_BYTES: u64 = 22;
/// Maximum length of the comment of an archive, bytes.
const COMMENT_BYTES: u64 = 65_535;
/// Value of a 32-bit field (`ELSEWHERE_16` for 16 bits) whose number is stored in the zip64 fields instead.
const ELSEWHERE: u64 = 0xffff_ffff;
const ELSEWHERE_16: u64 = 0xffff;

/// Reads the directory of an archive.
pub(crate) fn members(archive: &dyn ByteSource) -> Result<Vec<Packed>, Problem> {
    let directory = directory(archive)?;
    let bytes = bytes_of(archive, directory.at, directory.bytes)?;
    let mut rest = bytes.as_slice();
    let mut members = Vec::new();
    for _ in 0..directory.entries {
        let at = directory.at + (bytes.len() - rest.len()) as u64;
        let (member, behind) = entry(rest, at)?;
        rest = behind;
        if let Some(listed) = member {
            members.push(located(archive, listed)?);
        }
    }
    Ok(members)
}

struct Directory {
    entries: u64,
    at: u64,
    bytes: u64,
}

fn directory(archive: &dyn ByteSource) -> Result<Directory, Problem> {
    let length = archive.length();
    let tail_at = length.saturating_sub(END_BYTES + COMMENT_BYTES);
    let tail = bytes_of(archive, tail_at, length - tail_at)?;
    let is_end = |at: &usize| {
        let record = &tail[*at..];
        number(record, 0, 4) == Some(u64::from(END))
            && number(record, 20, 2)
                .is_some_and(|comment| comment + END_BYTES == record.len() as u64)
    };
    let at = (0..tail.len()).rev().find(is_end);
    let at = at.ok_or_else(|| {
        Problem::damaged(
            length,
            "the end",
            "the end record of a zip archive: the file is truncated, or not an archive",
        )
    })?;
    let record = &tail[at..];
    let end_at = tail_at + at as u64;
    let field = |place: usize, bytes: usize| number(record, place, bytes).unwrap_or(0);
    let mut found = Directory {
        entries: field(10, 2),
        bytes: field(12, 4),
        at: field(16, 4),
    };
    let is_64 = found.entries == ELSEWHERE_16 || found.bytes == ELSEWHERE || found.at == ELSEWHERE;
    if let (true, Some(locator_at)) = (is_64, end_at.checked_sub(20)) {
        let locator = bytes_of(archive, locator_at, 20)?;
        if number(&locator, 0, 4) == Some(u64::from(END_64_LOCATOR)) {
            let record_at = number(&locator, 8, 8).unwrap_or(u64::MAX);
            let record = bytes_of(archive, record_at, 56)?;
            if number(&record, 0, 4) != Some(u64::from(END_64)) {
                return Err(Problem::damaged(
                    record_at,
                    "no directory",
                    "the directory of zip64",
                ));
            }
            let field = |place: usize| number(&record, place, 8).unwrap_or(u64::MAX);
            found = Directory {
                entries: field(32),
                bytes: field(40),
                at: field(48),
            };
        }
    }
    if found.bytes > limits::DIRECTORY_BYTES {
        return Err(Problem::too_large(
            "bytes of the directory",
            found.bytes,
            limits::DIRECTORY_BYTES,
        ));
    }
    if found.entries > limits::ARRAYS {
        return Err(Problem::too_large(
            "members of the archive",
            found.entries,
            limits::ARRAYS,
        ));
    }
    if found
        .at
        .checked_add(found.bytes)
        .is_none_or(|end| end > end_at)
    {
        return Err(Problem::damaged(
            end_at,
            "a directory that overlaps its end record or follows it",
            "a directory before its end record",
        ));
    }
    Ok(found)
}

/// Parses one entry at offset `at` of the directory. Returns the member, `None` for a folder, and the remaining bytes.
fn entry(rest: &[u8], at: u64) -> Result<(Option<Packed>, &[u8]), Problem> {
    let cut = || Problem::damaged(at, "the end of the directory", "an entry");
    if number(rest, 0, 4).ok_or_else(cut)? != u64::from(ENTRY) {
        return Err(Problem::damaged(
            at,
            "no entry",
            "an entry of the directory",
        ));
    }
    let field = |place: usize, bytes: usize| number(rest, place, bytes).ok_or_else(cut);
    let flags = field(8, 2)?;
    let method = field(10, 2)?;
    let crc32 = u32::try_from(field(16, 4)?).unwrap_or(0);
    let mut packed_bytes = field(20, 4)?;
    let mut bytes = field(24, 4)?;
    let sizes = [field(28, 2)?, field(30, 2)?, field(32, 2)?]
        .map(|size| usize::try_from(size).unwrap_or(0));
    let mut local_at = field(42, 4)?;
    let name_end = 46 + sizes[0];
    let extra_end = name_end + sizes[1];
    let name = String::from_utf8_lossy(rest.get(46..name_end).ok_or_else(cut)?).into_owned();
    let extra = rest.get(name_end..extra_end).ok_or_else(cut)?;
    let behind = rest.get(extra_end + sizes[2]..).ok_or_else(cut)?;
    // Extra field 1 has the sizes and offset above 32 bits, in this order, and no others.
    let mut large = extra_field(extra, 1).unwrap_or(&[]);
    for size in [&mut bytes, &mut packed_bytes, &mut local_at] {
        if *size == ELSEWHERE {
            *size = number(large, 0, 8).ok_or_else(|| {
                Problem::damaged(at, "no 64-bit size", "a 64-bit size, as the entry states")
            })?;
            large = large.get(8..).unwrap_or(&[]);
        }
    }
    if name.ends_with('/') && bytes == 0 {
        return Ok((None, behind));
    }
    if flags & 1 != 0 {
        return Err(Problem::unsupported(
            format!("member `{}` is encrypted", shown(&name)),
            "save it without a password",
        ));
    }
    if method != 0 && method != 8 {
        return Err(Problem::unsupported(
            format!("member `{}` is compressed by method {method}", shown(&name)),
            "save it with `np.savez` or `np.savez_compressed`",
        ));
    }
    let member = Packed {
        name,
        wrapping: (method == 8).then_some(Wrapping::Raw),
        crc32: Some(crc32),
        at: local_at,
        packed_bytes,
        bytes,
    };
    member.check_size()?;
    Ok((Some(member), behind))
}

/// Adds the location of its bytes to a member that the directory lists. Its local header states the location.
fn located(archive: &dyn ByteSource, listed: Packed) -> Result<Packed, Problem> {
    let header = bytes_of(archive, listed.at, 30)?;
    let field = |place: usize, bytes: usize| number(&header, place, bytes).unwrap_or(0);
    let method = if listed.wrapping.is_some() { 8 } else { 0 };
    if field(0, 4) != u64::from(LOCAL) || field(8, 2) != method {
        return Err(Problem::damaged(
            listed.at,
            "no member header",
            format!(
                "the header of `{}`, as in the directory",
                shown(&listed.name)
            ),
        ));
    }
    let at = listed.at + 30 + field(26, 2) + field(28, 2);
    let is_inside = at
        .checked_add(listed.packed_bytes)
        .is_some_and(|end| end <= archive.length());
    if !is_inside {
        return Err(Problem::damaged(
            archive.length(),
            "the end",
            format!(
                "{} bytes of `{}` from byte {at}",
                listed.packed_bytes,
                shown(&listed.name)
            ),
        ));
    }
    Ok(Packed { at, ..listed })
}

fn extra_field(mut extra: &[u8], wanted: u64) -> Option<&[u8]> {
    loop {
        let id = number(extra, 0, 2)?;
        let size = usize::try_from(number(extra, 2, 2)?).ok()?;
        let field = extra.get(4..4 + size)?;
        if id == wanted {
            return Some(field);
        }
        extra = &extra[4 + size..];
    }
}

/// Little-endian number of `length` bytes, at most 8, at offset `at`; `None` if they exceed `bytes`.
fn number(bytes: &[u8], at: usize, length: usize) -> Option<u64> {
    let bytes = bytes.get(at..at + length)?;
    Some(
        bytes
            .iter()
            .rev()
            .fold(0, |number, byte| number << 8 | u64::from(*byte)),
    )
}
