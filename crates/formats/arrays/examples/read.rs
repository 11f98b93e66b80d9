//! Lists the arrays of a file, or reads one array some rows at a time.
//!
//! ```text
//! cargo run --release -p taceva-arrays --example read -- FILE [ARRAY [ROWS]]
//! ```

#![expect(clippy::print_stdout, reason = "an example prints its results")]

use std::path::Path;

use taceva_arrays::{ArrayFile, ArrayFormat};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("which file?")?;
    let path = Path::new(&path);
    let format = ArrayFormat::of(path).ok_or("the extension of the file is unknown")?;
    let file = ArrayFile::open(path, format)?;
    let Some(array) = arguments.next() else {
        for name in file.names() {
            if let Some(info) = file.info(&name) {
                println!("{name}: {:?} {}", info.shape, info.element);
            }
        }
        return Ok(());
    };
    let step: u64 = arguments.next().map_or(Ok(1), |rows| rows.parse())?;
    let rows = file.info(&array).map_or(0, |info| info.rows());
    let mut elements = 0;
    let mut start = 0;
    while start < rows {
        let end = start.saturating_add(step.max(1)).min(rows);
        elements += file.read(&array, start..end)?.values.len();
        start = end;
    }
    println!("{elements} elements in {rows} rows");
    if let Some(peak) = peak_kib() {
        println!("at most {peak} KiB of memory");
    }
    Ok(())
}

/// Peak memory of this process, KiB; `None` if the system does not report it (only Linux does).
fn peak_kib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}
