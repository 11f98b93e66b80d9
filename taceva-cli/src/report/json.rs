//! JSON, with one line for each value and every number in its shortest round-trip form.

use std::io::{self, Write};

use serde::Serialize;

pub(super) fn write(report: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, report)?;
    writeln!(out)
}

/// Same as `write`, with a seal that detects later changes.
pub(super) fn write_sealed(report: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    let sealed = taceva_results::sealed(report).map_err(io::Error::other)?;
    writeln!(out, "{sealed}")
}
