//! Benchmark of rendering a page from results and samples in memory.

#[path = "../tests/support/mod.rs"]
mod support;

use divan::{Bencher, black_box};
use taceva_report::{ReportPage, report};
use taceva_results::Samples;

fn main() {
    divan::main();
}

/// Renders the whole page of one sensor.
#[divan::bench(args = [1_000, 100_000], sample_count = 5)]
fn page(bencher: Bencher<'_, '_>, samples: usize) {
    let studies = [support::drawn("drawn", samples, 1.0)];
    bencher.bench(|| {
        report(&ReportPage {
            title: "drawn",
            studies: black_box(&studies),
            pictures: &[],
            triples: &[],
        })
        .len()
    });
}

/// Reads the table of samples.
#[divan::bench(args = [1_000, 100_000], sample_count = 5)]
fn read_samples(bencher: Bencher<'_, '_>, samples: usize) {
    let table = support::samples("drawn", samples, 1.0);
    bencher.bench(|| Samples::read(black_box(&table)).expect("samples").rows());
}
