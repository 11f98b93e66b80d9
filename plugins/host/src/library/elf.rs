//! Whether a file is a whole shared library of this machine: the system's loader maps what the headers say, and dies where the file ends.

use std::fs::File;
use std::os::unix::fs::FileExt;

use super::error::LoadProblem;

/// Bytes of the header of a file of 64 bits.
const HEADER: usize = 64;
/// Bytes of the header of a segment.
const SEGMENT: usize = 56;
/// A library has no more segments.
const SEGMENTS_MAX: u16 = 512;
/// A segment that is mapped.
const LOADED: u32 = 1;

/// Refuses `file` unless it is a shared library for this machine that is as long as its headers say.
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

/// The type of a shared library.
const SHARED: u16 = 3;
/// 64 bits.
const CLASS: u8 = 2;
/// Little-endian.
const ORDER: u8 = 1;
/// The number of this machine.
const MACHINE: u16 = if cfg!(target_arch = "x86_64") {
    62
} else if cfg!(target_arch = "aarch64") {
    183
} else {
    // RISC-V; no other machine of 64 bits and this order is among the platforms of a manifest.
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
