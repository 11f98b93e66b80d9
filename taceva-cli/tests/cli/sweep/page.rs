//! Page of a sweep: the choice, its criterion, and the candidates without a verdict.

use super::store::whole;
use super::{small, text, week};

#[test]
fn the_page_chooses_on_validation_parts_and_keeps_times_apart() {
    let bench = whole();
    let page = text(&bench, "one/page.html");
    for words in [
        "Best of each question",
        "Choices use no test part",
        "95 % over contact points",
        "95 % over seeds",
        "Effect of each setting",
        "Holm",
        "Nothing here was measured",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("s per task"));
    assert!(text(&bench, "one/times.html").contains("s per task"));
    // By the table alone, the choice has the least error on validation parts of all candidates.
    let table = text(&bench, "one/table.csv");
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let head: Vec<String> = reader
        .headers()
        .expect("a head")
        .iter()
        .map(str::to_owned)
        .collect();
    let at = |name: &str| head.iter().position(|known| known == name).expect(name);
    let mut sums = std::collections::BTreeMap::<(String, String), f64>::new();
    for row in reader.records() {
        let row = row.expect("a row");
        if &row[at("part")] == "validation"
            && &row[at("channel")] == "Fz"
            && &row[at("dataset")] == "monday"
        {
            let of = (row[at("model")].to_owned(), row[at("set.size")].to_owned());
            *sums.entry(of).or_default() += row[at("value")].parse::<f64>().expect("a number");
        }
    }
    assert_eq!(sums.len(), 8);
    let least = sums
        .iter()
        .min_by(|left, right| left.1.total_cmp(right.1))
        .expect("eight");
    let (_, row) = page.split_once("normal force").expect("a question");
    let row = row.split("</tr>").next().expect("a row");
    let (model, size) = least.0;
    assert!(
        row.contains(&format!("{model} ")) && row.contains(&format!("size={size}")),
        "{least:?}: {row}"
    );
}

#[test]
fn models_that_were_no_candidates_and_settings_of_one_model_stand_on_the_page_by_name() {
    let bench = week();
    let twice = "{ name = \"knn\", set = { neighbours = 1 } }, { name = \"knn\"";
    small(
        &bench,
        &[
            ("\"pls\", ", ""),
            ("{ name = \"knn\"", twice),
            ("50/10/40", "60/0/40"),
        ],
    );
    bench.ok("sweep which.toml -q");
    let page = text(&bench, "which.sweep/page.html");
    let (_, names) = page
        .split_once("Excluded, because they report no such error: ")
        .expect(&page);
    assert!(names.starts_with("baseline size=8x8; "), "{page}");
    for words in ["neighbours of knn", "knn neighbours=1", "knn neighbours=3"] {
        assert!(page.contains(words), "{words}");
    }
}
