//! Benchmark of table parsing: `cargo bench -p taceva-import`.

use std::fmt::Write;

use divan::Bencher;
use taceva_import::CsvTable;

fn main() {
    divan::main();
}

/// Parses a table of seven columns of 16- or 17-digit numbers: 110 MB for a million rows.
#[divan::bench(args = [10_000, 1_000_000], sample_count = 5)]
fn parse_every_column(bencher: Bencher<'_, '_>, rows: usize) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("table.csv");
    let names = ["id", "Px", "Py", "Pz", "Fx", "Fy", "Fz"];
    let mut text = names.join(",") + "\n";
    let mut state = 7_u64;
    for row in 0..rows {
        write!(text, "{row}").expect("text grows");
        for _ in 1..names.len() {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let unit = f64::from((state >> 32) as u32) / f64::from(u32::MAX);
            write!(text, ",{}", unit.sqrt() * 6.0 - 3.0).expect("text grows");
        }
        text.push('\n');
    }
    std::fs::write(&path, &text).expect("written");
    bencher.bench(|| {
        let table = CsvTable::read(&path).expect("reads");
        names.map(|name| table.numbers(name).expect("numbers").len())
    });
}
