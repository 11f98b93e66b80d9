//! Measures the cost of reading a file. `measure FILE COLUMN [TOPIC]` visits every picture in COLUMN once, or reads the whole column if it contains no
//! pictures. Prints processor time and peak memory of this process, and the load of the machine.
//!
//! ```text
//! cargo run --release -p taceva-tables --example measure -- run.parquet image.bytes
//! cargo run --release -p taceva-tables --example measure -- run.mcap data /tactile/image/compressed
//! ```

use std::path::Path;

use rustix::time::{ClockId, clock_gettime};
use taceva_tables::{ColumnKind, ParquetTable, Picture, Recording, TableError};

fn main() -> Result<(), TableError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, column, topic @ ..] = arguments.as_slice() else {
        print("measure FILE COLUMN [TOPIC]");
        return Ok(());
    };
    let (mut pictures, mut bytes) = (0_u64, 0_u64);
    let mut count = |length: usize| {
        pictures += 1;
        bytes += length as u64;
        Ok::<(), TableError>(())
    };
    match topic {
        [] => {
            let table = ParquetTable::open(Path::new(file))?;
            let rows: Vec<u64> = (0..table.rows()).collect();
            if table.kind(column)? != ColumnKind::Bytes {
                for cell in table.column(column)? {
                    count(cell.text().len())?;
                }
                return report(pictures, bytes);
            }
            table.visit_bytes(column, &rows, &mut |_, cell| {
                count(cell.map_or(0, |cell| cell.len()))
            })?;
        }
        [topic, ..] => {
            let table = Recording::open(Path::new(file))?.table(topic)?;
            if !table.topic().schema.ends_with("Image") {
                for cell in table.column(column)? {
                    count(cell.text().len())?;
                }
                return report(pictures, bytes);
            }
            let rows: Vec<u64> = (0..table.rows()).collect();
            table.visit_pictures(column, &rows, &mut |_, picture| match picture {
                Picture::Encoded(encoded) => count(encoded.len()),
                Picture::Samples(samples) => count(samples.bytes.len()),
                _ => Ok(()),
            })?;
        }
    }
    report(pictures, bytes)
}

/// Prints processor time, peak memory and load.
fn report(cells: u64, bytes: u64) -> Result<(), TableError> {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))
        .unwrap_or(" unknown");
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    print(&format!(
        "{cells} cells, {bytes} bytes: {}.{:03} s of processor time, peak{peak}, load {}",
        time.tv_sec,
        time.tv_nsec / 1_000_000,
        load.split(' ').next().unwrap_or("unknown"),
    ));
    Ok(())
}

#[expect(clippy::print_stdout, reason = "an example prints")]
fn print(text: &str) {
    println!("{text}");
}
