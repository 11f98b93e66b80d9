//! Tables of truth and predictions, as CSV and as Parquet.

use std::path::Path;

use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

use crate::support::Bench;
use crate::support::sweeps::tables;

const SENSOR: &str = "model = \"drawn\"\nopaque = true\n\n[footprint]\nshape = \"rect\"\nhalf_x_mm = 5.0\nhalf_y_mm = 5.0\ndepth_max_mm = 1.0\n";
pub(crate) const SWEEP: &str = "sweep_version = 1\nsensor = \"sensor.toml\"\n[score]\ntruth = \"truth.csv\"\npred = \"pred.csv\"\nshards = 7\n";

/// Test folder with tables of truth and predictions, as CSV and as Parquet. Many rows exceed the size of one read.
pub(crate) fn bench(rows: u32, with_ids: bool) -> Bench {
    let bench = Bench::new();
    bench.write("sensor.toml", SENSOR);
    bench.write("which.toml", SWEEP);
    for (name, text) in ["truth", "pred"].into_iter().zip(tables(rows, with_ids)) {
        bench.write(&format!("{name}.csv"), &text);
        write_parquet(&bench.path(&format!("{name}.parquet")), &text);
    }
    bench
}

/// Writes the CSV table `text` as Parquet.
pub(crate) fn write_parquet(path: &Path, text: &str) {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let kind = |name: &str| match name {
        "id" => WrittenKind::Integer,
        "point_id" => WrittenKind::Text,
        _ => WrittenKind::Number,
    };
    let columns = names
        .iter()
        .map(|name| WrittenColumn::new(*name, kind(name)));
    let columns: Vec<WrittenColumn> = columns.collect();
    let mut writer = ParquetWriter::create(path, &columns, &[]).expect("made");
    for line in lines {
        let cells = line.split(',').zip(&names).map(|(cell, name)| match *name {
            "id" => Cell::Integer(cell.parse().expect("a number")),
            "point_id" => Cell::Text(cell.to_owned()),
            _ => Cell::Number(cell.parse().expect("a number")),
        });
        writer.push(cells.collect()).expect("written");
    }
    writer.finish().expect("written");
}
