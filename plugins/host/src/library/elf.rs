//! Check of a shared library before loading: the system's loader crashes on a truncated file.

use std::fs::File;
use std::os::unix::fs::FileExt;

use super::error::LoadProblem;

/// Size of a 64-bit ELF header, bytes.
const HEADER: usize = 64;
/// Size of a segment header, bytes.
const SEGMENT: usize = 56;
/// Maximum number of segments.
const SEGMENTS_MAX: u16 = 512;
/// Type of a mapped segment, `PT_LOAD`.
const LOADED: u32 = 1;

/// Rejects `file` unless it is a shared library for this machine and not shorter than its headers state.
pub(super) fn check(file: &File) -> Result<(), LoadProblem> {
    let length = file.metadata().map_err(LoadProblem::File)?.len();
    let mut header = [0; HEADER];
    if length < HEADER as u64 {
        return Err(LoadProblem::NotALibrary);
    }
    file.read_exact_at(&mut header, 0)
        .map_err(LoadProblem::File)?;
    if &header[..4] != b"\x7fELF" || u16_at(&header, 16) != SHARED {
        return Err(LoadProblem::NotALibrary);
    }
    if header[4] != CLASS || header[5] != ORDER || u16_at(&header, 18) != MACHINE {
        return Err(LoadProblem::OtherMachine);
    }
    let (offset, size, count) = (
        u64_at(&header, 32),
        u16_at(&header, 54),
        u16_at(&header, 56),
    );
    if usize::from(size) != SEGMENT || count == 0 || count > SEGMENTS_MAX {
        return Err(LoadProblem::NotALibrary);
    }
    let mut segments = vec![0; SEGMENT * usize::from(count)];
    if !fits(offset, segments.len() as u64, length) {
        return Err(LoadProblem::CutOff);
    }
    file.read_exact_at(&mut segments, offset)
        .map_err(LoadProblem::File)?;
    let is_whole = segments
        .chunks_exact(SEGMENT)
        .filter(|segment| u32_at(segment, 0) == LOADED)
        .all(|segment| fits(u64_at(segment, 8), u64_at(segment, 32), length));
    if is_whole {
        Ok(())
    } else {
        Err(LoadProblem::CutOff)
    }
}

/// Run path of `file`, unexpanded; `None` if it has none.
pub(super) fn run_path(file: &File) -> Option<String> {
    let mut header = [0; HEADER];
    file.read_exact_at(&mut header, 0).ok()?;
    let count = u16_at(&header, 56).min(SEGMENTS_MAX);
    let mut segments = vec![0; SEGMENT * usize::from(count)];
    file.read_exact_at(&mut segments, u64_at(&header, 32))
        .ok()?;
    let of_kind = |kind| {
        let segments = segments.chunks_exact(SEGMENT);
        segments.filter(move |segment| u32_at(segment, 0) == kind)
    };
    let dynamic = of_kind(DYNAMIC).next()?;
    let length = usize::try_from(u64_at(dynamic, 32).min(DYNAMIC_MAX)).ok()?;
    let mut entries = vec![0; length];
    file.read_exact_at(&mut entries, u64_at(dynamic, 8)).ok()?;
    let value = |tag| {
        let mut entries = entries.chunks_exact(ENTRY);
        entries.find_map(|entry| (u64_at(entry, 0) == tag).then(|| u64_at(entry, 8)))
    };
    let address = value(TEXTS)?.checked_add(value(RUN_PATH).or_else(|| value(OLD_RUN_PATH))?)?;
    let offset = of_kind(LOADED).find_map(|segment| {
        let within = address.checked_sub(u64_at(segment, 16))?;
        (within < u64_at(segment, 32)).then(|| u64_at(segment, 8).checked_add(within))?
    })?;
    let mut text = vec![0; RUN_PATH_MAX];
    let read = file.read_at(&mut text, offset).ok()?;
    let text = text[..read].split(|byte| *byte == 0).next()?;
    Some(String::from_utf8_lossy(text).into_owned())
}

/// Type of the dynamic segment, `PT_DYNAMIC`.
const DYNAMIC: u32 = 2;
/// Maximum size of the dynamic segment that is read, bytes.
const DYNAMIC_MAX: u64 = 1 << 16;
/// Size of a dynamic entry, bytes: tag and value.
const ENTRY: usize = 16;
/// Tag of the string table, `DT_STRTAB`.
const TEXTS: u64 = 5;
/// Tags of the run path: `DT_RUNPATH` and the older `DT_RPATH`.
const RUN_PATH: u64 = 29;
const OLD_RUN_PATH: u64 = 15;
/// Maximum length of a run path that is read, bytes.
const RUN_PATH_MAX: usize = 4096;

/// ELF type of a shared library, `ET_DYN`.
const SHARED: u16 = 3;
/// ELF class of 64-bit files.
const CLASS: u8 = 2;
/// ELF byte order: little-endian.
const ORDER: u8 = 1;
/// ELF machine number of this target.
const MACHINE: u16 = if cfg!(target_arch = "x86_64") {
    62
} else if cfg!(target_arch = "aarch64") {
    183
} else {
    // RISC-V, the only other 64-bit little-endian platform that a manifest may name.
    243
};

fn fits(offset: u64, size: u64, length: u64) -> bool {
    offset.checked_add(size).is_some_and(|end| end <= length)
}

fn bytes<const N: usize>(header: &[u8], at: usize) -> [u8; N] {
    let part = header[at..at + N].try_into();
    part.expect("a part of N bytes has N bytes")
}

fn u16_at(header: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(bytes(header, at))
}

fn u32_at(header: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes(header, at))
}

fn u64_at(header: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes(header, at))
}
