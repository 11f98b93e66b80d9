use std::num::NonZeroUsize;

use super::*;

#[test]
fn text_longer_than_memory_may_hold_is_read_in_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let of_length = |name: &str, bytes: u64| {
        let path = folder.path().join(name);
        // The file is sparse: no data is written.
        let file = fs::File::create(&path).expect("created");
        file.set_len(bytes).expect("a hole takes no room");
        path
    };
    let request = |truth, prediction| ScoreRequest {
        truth,
        prediction,
        units: Vec::new(),
        periods: Vec::new(),
        key: None,
        is_independent: false,
        sensor: None,
        metrics: Vec::new(),
        allow_invalid: false,
        jobs: NonZeroUsize::MIN,
    };
    let short = of_length("short.csv", CsvTable::MOST_BYTES);
    let long = of_length("long.csv", CsvTable::MOST_BYTES + 1);
    assert!(!ScoreTables::are_in_parts(&request(
        short.clone(),
        short.clone()
    )));
    assert!(ScoreTables::are_in_parts(&request(
        short.clone(),
        long.clone()
    )));
    assert!(ScoreTables::are_in_parts(&request(long, short)));
}
