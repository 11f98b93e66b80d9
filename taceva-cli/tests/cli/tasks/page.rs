//! Pages of the scores of tasks.

use super::{SLIP, slip};
use crate::support::Bench;

#[test]
fn the_page_of_a_task_has_the_scores_of_the_terminal_the_matrix_the_curve_and_the_delays() {
    let bench = Bench::new();
    slip(&bench);
    let table = bench.ok(&format!("{SLIP} --html page.html"));
    let page = std::fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(
        table.contains("intervals by 6 clusters of the column `stroke`"),
        "{table}"
    );
    for words in [
        "intervals by 6 clusters of the column `stroke`",
        "best constant",
        "slip as no_slip: 11 of 36",
        "prevalence 0.6: all positive",
        "60 samples of 6 clusters by stroke",
        "of 5 matched onsets",
    ] {
        assert!(page.contains(words), "{words}");
    }
    bench.refused(&format!("{SLIP} --html page.html"), 3, "exists already");
}

#[test]
fn the_page_of_an_evaluated_task_shows_pictures_of_its_errors() {
    let bench = Bench::new();
    let drawn = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/presets/sparsh-slip");
    bench.ok(&format!(
        "import {drawn} --preset sparsh-force --out slips -q"
    ));
    // One label of a bright picture is wrong, so its prediction is an error.
    bench.ok("export slips --format csv --out table -q");
    let labels = std::fs::read_to_string(bench.path("table/labels.csv")).expect("a table");
    // The header has an attribute of this name.
    let rows = labels.find('\n').expect("a header");
    let at = rows + labels[rows..].find(",slip,").expect("a label");
    let changed = format!("{},no_slip,{}", &labels[..at], &labels[at + 6..]);
    bench.write("table/labels.csv", &changed);
    bench.ok("import table --map table/map.toml --out changed -q");
    bench.ok(
        "evaluate changed --task slip --model lda --set size=16x12 --no-cache --html page.html -q",
    );
    let page = std::fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(page.contains("Pictures of errors"), "{page}");
    assert!(page.contains("no_slip as slip"), "{page}");
    assert!(page.contains("data:image/jpeg;base64,"), "{page}");
}
