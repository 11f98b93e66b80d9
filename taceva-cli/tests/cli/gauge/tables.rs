//! Tables of readings: the worked example of AIAG, and two simulated units.

use serde_json::Value;
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

use crate::support::Bench;

/// Arguments of the gauge study of the worked example of AIAG.
pub(crate) const AIAG: &str =
    "gauge study.csv --part part --by appraiser --trial trial --channels length";

/// Golden values of the crate `taceva-metrology`.
pub(crate) fn golden(name: &str) -> Value {
    let text = match name {
        "msa" => include_str!("../../../../crates/results/metrology/tests/golden/msa.json"),
        _ => include_str!("../../../../crates/results/metrology/tests/golden/nested.json"),
    };
    serde_json::from_str(text).expect("JSON")
}

/// Test folder with `study.csv`: ten parts, measured three times by three appraisers.
pub(crate) fn aiag() -> Bench {
    let golden = golden("msa");
    let mut table = String::from("part,appraiser,trial,length\n");
    for appraiser in ["A", "B", "C"] {
        for trial in 0..3_usize {
            for part in 0..10_usize {
                let length = &golden["data"][appraiser][trial][part];
                table.push_str(&format!(
                    "p{:02},{appraiser},{},{length}\n",
                    part + 1,
                    trial + 1
                ));
            }
        }
    }
    let bench = Bench::new();
    bench.write("study.csv", &table);
    bench
}

/// Content of `study.csv`.
pub(crate) fn rows_of(bench: &Bench) -> String {
    std::fs::read_to_string(bench.path("study.csv")).expect("there")
}

/// Writes the rows of `study.csv` as `study.parquet`.
pub(crate) fn write_parquet(bench: &Bench) {
    let columns = ["part", "appraiser", "trial"].map(|name| {
        let kind = match name {
            "trial" => WrittenKind::Integer,
            _ => WrittenKind::Text,
        };
        WrittenColumn::new(name, kind)
    });
    let length = WrittenColumn::new("length", WrittenKind::Number);
    let columns: Vec<WrittenColumn> = columns.into_iter().chain([length]).collect();
    let path = bench.path("study.parquet");
    let mut writer = ParquetWriter::create(&path, &columns, &[]).expect("made");
    for row in rows_of(bench).lines().skip(1) {
        let cells = row
            .split(',')
            .enumerate()
            .map(|(column, cell)| match column {
                2 => Cell::Integer(cell.parse().expect("a number")),
                3 => Cell::Number(cell.parse().expect("a number")),
                _ => Cell::Text(cell.to_owned()),
            });
        writer.push(cells.collect()).expect("written");
    }
    writer.finish().expect("written");
}

/// Test folder with `units.csv`: samples of two simulated units at three places and two depths, twice each.
pub(crate) fn simulated_units() -> Bench {
    let mut table = String::from(
        "sample,point_id,unit_id,depth_step,repeat,Fz,Pz,Fz_predicted,Pz_predicted,source\n",
    );
    let mut sample = 0;
    for (point, place) in [("a", 1.0), ("b", 2.0), ("c", 3.5)] {
        for (step, depth) in [(0, 0.4), (1, 0.9)] {
            for (unit, offset) in [(1, 0.0), (2, 0.02)] {
                for (repeat, noise) in [(1, 0.004), (2, -0.003)] {
                    sample += 1;
                    let force = 0.3 * place * depth;
                    let error = offset + noise * place;
                    table.push_str(&format!(
                        "s{sample},{point},{unit},{step},{repeat},{force:?},{depth:?},{:?},{:?},simulated\n",
                        force + error,
                        depth + 2.0 * error
                    ));
                }
            }
        }
    }
    let bench = Bench::new();
    bench.write("units.csv", &table);
    bench
}
