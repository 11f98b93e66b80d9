//! Tests of reports of synthetic results: nothing is missing, no text acts as markup, and size and time stay within their limits.

mod methods;
mod metrology;

use std::time::{Duration, Instant};

use crate::support::{self, drawn};
use taceva_report::{
    CompareRequest, Layout, ReportPage, ScoreTable, Study, compare, figures, picks, report,
};

pub(crate) fn page(studies: &[Study]) -> String {
    report(&ReportPage {
        title: "drawn",
        studies,
        pictures: &[],
        triples: &[],
    })
}

#[test]
fn every_figure_of_the_list_is_drawn_and_none_is_empty() {
    let studies = [drawn("one", 200, 1.0), drawn("two", 200, 1.5)];
    let drawn = figures(&studies);
    let ids: Vec<&str> = drawn.iter().map(|figure| figure.id.as_str()).collect();
    assert_eq!(
        ids,
        [
            "labels",
            "predicted-1",
            "predicted-2",
            "sensitivity",
            "distance",
            "depth",
            "resolution",
            "lighting",
            "repeatability",
            "repeatability-volumes",
            "hysteresis",
            "units",
            "bias",
            "tolerance",
            "crosstalk",
            "radar-accuracy",
            "radar-robustness"
        ]
    );
    for figure in &drawn {
        assert!(
            figure.marks() > 20,
            "{}: {} marks",
            figure.id,
            figure.marks()
        );
        assert!(!figure.caption.is_empty() && !figure.description.is_empty());
        let svg = figure.svg();
        assert!(
            svg.starts_with("<svg xmlns") && !svg.contains("NaN") && !svg.contains("inf"),
            "{}",
            figure.id
        );
    }
}

#[test]
fn results_without_samples_or_scores_give_a_page_that_says_so() {
    assert!(page(&[]).contains("There is no sensor in these results."));
    let empty = support::read(
        &serde_json::json!({"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {}}),
    )
    .expect("a result");
    let page = page(&empty);
    assert!(
        page.contains("There is no score in these results.")
            && page.contains("There is nothing to draw")
    );
}

#[test]
fn a_huge_map_is_said_to_be_one_and_not_drawn() {
    let mut result = support::results("x", 1.0);
    let edges: Vec<f64> = (0..=400).map(f64::from).collect();
    let map = serde_json::json!({"x_mm": edges, "y_mm": edges, "values": vec![vec![1.0; 400]; 400], "counts": vec![vec![1; 400]; 400], "unit": "mm/N"});
    result["metrics"]["sensitivity"]["Fz"]["map"] = map;
    let studies = support::read(&result).expect("a result");
    let page = page(&studies);
    assert!(page.contains("160000 cells: too many to draw") && page.len() < 1_000_000);
}

#[test]
fn mixed_units_stand_in_rows_of_their_own() {
    let metre = support::results("a", 1.0);
    let mut newton = support::results("b", 1.0);
    newton["metrics"]["mae"]["Pz"]["unit"] = "N".into();
    let studies: Vec<Study> = [metre, newton]
        .iter()
        .flat_map(|json| support::read(json).expect("a result"))
        .collect();
    let table = ScoreTable::of(&studies);
    let rows = table
        .rows
        .iter()
        .filter(|row| row.metric == "mae" && row.channel == "Pz");
    assert_eq!(rows.count(), 2);
    let comparison = compare(&studies, &CompareRequest::default());
    let answer = comparison
        .answers
        .iter()
        .find(|answer| answer.metric == "mae" && answer.channel == "Pz")
        .expect("one");
    assert!(
        answer
            .reason
            .as_deref()
            .is_some_and(|reason| reason.contains("the definitions"))
    );
}

#[test]
fn another_schema_and_what_is_no_number_are_refused_by_their_place() {
    let error = Study::read(r#"{"schema": "taceva.evaluation/2"}"#).expect_err("another schema");
    assert!(error.to_string().contains("taceva.evaluation/2"));
    let mut result = support::results("x", 1.0);
    result["metrics"]["mae"]["Fz"]["value"] = "much".into();
    let error = support::read(&result).expect_err("no number");
    let problem = "metrics.mae.Fz.value: invalid type: string \"much\", expected f64";
    assert!(error.to_string().starts_with(problem), "{error}");
    let mut result = support::results("x", 1.0);
    result["metrics"]["sr"]["line"]["curve"]["counts"] = serde_json::json!([1]);
    let error = support::read(&result).expect_err("one count");
    assert!(
        error
            .to_string()
            .starts_with("metrics.sr.line.curve: expected one value for each place"),
        "{error}"
    );
}

#[test]
fn pairs_of_the_same_samples_are_compared_one_by_one() {
    let a = support::results("a", 1.0);
    let table = support::samples("s", 120, 1.0);
    let mut studies: Vec<Study> = Vec::new();
    for scale in [1.0, 2.0] {
        let samples =
            taceva_results::Samples::read(&support::samples("s", 120, scale)).expect("samples");
        let force = samples.channel("Fz").expect("there");
        let errors: Vec<f64> = samples
            .of_protocol("calibration")
            .iter()
            .filter_map(|row| force.pair(*row))
            .map(|[t, p]| (t - p).abs())
            .collect();
        let mut result = a.clone();
        result["metrics"]["mae"]["Fz"]["value"] =
            (errors.iter().sum::<f64>() / errors.len() as f64).into();
        result["metrics"]["mae"]["Fz"]["n"] = errors.len().into();
        let mut study = support::study(&result);
        study.samples = Some(samples);
        studies.push(study);
    }
    assert!(!table.is_empty());
    let comparison = compare(&studies, &CompareRequest::default());
    let answer = comparison
        .answers
        .iter()
        .find(|answer| answer.metric == "mae" && answer.channel == "Fz")
        .expect("one");
    let difference = answer.difference.as_ref().expect("tested");
    assert!(
        difference.test.to_string().starts_with("paired sign flip"),
        "{}",
        difference.test
    );
    assert_eq!(answer.better(), Some(0));
    let other = comparison
        .answers
        .iter()
        .find(|answer| answer.metric == "mae" && answer.channel == "Pxy")
        .expect("one");
    assert!(
        other
            .difference
            .as_ref()
            .expect("tested")
            .test
            .to_string()
            .starts_with("by the intervals")
    );
}

#[test]
fn bold_needs_more_than_the_best_value() {
    let table = |scale: f64| {
        let studies = [drawn("one", 40, 1.0), drawn("two", 40, scale)];
        ScoreTable::of(&studies).headlines()
    };
    // Intervals of ±10 % of 0.1: 0.101 does not differ, 0.2 does.
    assert!(
        !table(1.01)
            .for_papers("near")
            .latex(Layout::Float)
            .contains("textbf")
    );
    let far = table(2.0).for_papers("far").latex(Layout::Float);
    assert!(
        far.contains("\\textbf{0.100}") && far.contains("\\toprule"),
        "{far}"
    );
    assert!(table(2.0).for_pages().markdown().contains("**0.100**"));
}

#[test]
fn every_naughty_string_is_only_words() {
    let strings: Vec<&str> = naughty_strings::BLNS
        .iter()
        .copied()
        .filter(|text| !text.is_empty())
        .collect();
    assert!(strings.len() > 500);
    let plain = elements(&page(&[drawn("plain", 40, 1.0), drawn("other", 40, 1.3)]));
    for text in strings {
        let studies = [drawn(text, 40, 1.0), drawn("other", 40, 1.3)];
        let page = page(&studies);
        // The same elements for all names: nothing became markup.
        let found = elements(&page);
        let differs = (0..plain.len().max(found.len())).find(|at| plain.get(*at) != found.get(*at));
        assert_eq!(
            differs,
            None,
            "{text:?}: {:?}",
            differs.map(|at| &found[at.saturating_sub(3)..])
        );
        assert_eq!(page.matches("<script").count(), 1, "{text:?}");
        let table = ScoreTable::of(&studies);
        for line in table.every_number().csv().lines() {
            assert!(!line.starts_with(['=', '+', '-', '@']), "{text:?}: {line}");
        }
        let comparison = compare(&studies, &CompareRequest::default());
        let words = comparison.overview(None) + &comparison.text();
        assert!(
            words
                .chars()
                .all(|letter| letter == '\n' || !letter.is_control()),
            "{text:?}"
        );
    }
}

/// Names of the elements of a page, in order.
fn elements(page: &str) -> Vec<String> {
    let body = page.split("<body>").nth(1).expect("a body");
    let body = body.split("<script>").next().expect("a script");
    body.split('<')
        .skip(1)
        .map(|tag| {
            tag.split([' ', '>', '/'])
                .next()
                .unwrap_or_default()
                .to_owned()
        })
        .collect()
}

#[test]
fn a_hundred_thousand_samples_are_a_page_below_five_megabytes() {
    let studies = [drawn("many", 100_000, 1.0)];
    let begin = Instant::now();
    let page = page(&studies);
    let taken = begin.elapsed();
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
    // The limit is two seconds for an optimised build; this is a debug build.
    assert!(taken < Duration::from_secs(20), "{taken:?}");
    assert!(page.contains("100000 samples, 400 drawn"));
    assert_eq!(picks(&studies[0]).len(), 8);
}

#[test]
fn the_same_results_give_the_same_bytes() {
    let studies = [drawn("one", 60, 1.0), drawn("two", 60, 1.2)];
    assert_eq!(page(&studies), page(&studies));
}

#[test]
fn samples_that_are_shown_are_of_different_contact_points() {
    let studies = [drawn("one", 200, 1.0)];
    let samples = studies[0].samples.as_ref().expect("samples");
    let picked = picks(&studies[0]);
    let mut points: Vec<&str> = picked
        .iter()
        .filter_map(|pick| samples.word("point_id", pick.row))
        .collect();
    points.sort_unstable();
    points.dedup();
    assert_eq!([picked.len(), points.len()], [8, 8]);
    let worst = picked.iter().filter(|pick| pick.is_worst);
    let least_of_worst = worst.map(|pick| pick.error).fold(f64::INFINITY, f64::min);
    let best = picked.iter().filter(|pick| !pick.is_worst);
    assert!(best.map(|pick| pick.error).fold(0.0, f64::max) < least_of_worst);
}

#[test]
fn samples_that_are_shown_are_of_different_groups_of_the_split() {
    let mut studies = [drawn("one", 200, 1.0)];
    let samples = studies[0].samples.as_mut().expect("samples");
    let group = |row: usize| Some(format!("object {}", row % 6));
    let groups = (0..samples.rows()).map(group).collect();
    samples.push_words("group", groups);
    let samples = studies[0].samples.as_ref().expect("samples");
    let picked = picks(&studies[0]);
    let groups = picked
        .iter()
        .filter_map(|pick| samples.word("group", pick.row));
    let groups: std::collections::BTreeSet<&str> = groups.collect();
    assert_eq!([picked.len(), groups.len()], [6, 6]);
    let page = page(&studies);
    assert!(page.contains("each of a different group of the split."));
}

#[test]
fn scores_over_seeds_stand_on_the_page_where_there_are_any() {
    let mut result = support::results("seeded", 1.0);
    let without = support::read(&result).expect("a result");
    assert!(!page(&without).contains("id=\"seeds\""));
    result["over_seeds"] = serde_json::json!({
        "seeds": [3, 1, 2], "decides": "first weights",
        "scores": [{"metric": "mae", "channel": "Pz", "unit": "mm", "values": [0.1, null, 0.3],
                    "mean": 0.2, "standard_deviation": 0.1, "interval": [0.05, 0.35]}]
    });
    let studies = support::read(&result).expect("a result");
    let page = page(&studies);
    assert!(page.contains(
        "seeds 3, 1, 2; a seed decides first weights. All other scores of this page are of seed 3."
    ));
    assert!(page.contains("</a> ↓</th><td>Pz</td><td>mm</td>") && page.contains("0.05 … 0.35"));
    assert!(page.contains("Each model was fitted with the seeds 3, 1 and 2."));
    let scope = "between units, and intervals do not include that between trainings.";
    assert!(page.contains(scope), "{page}");
    result["over_seeds"]["scores"][0]["interval"] = serde_json::json!([1]);
    let error = support::read(&result).expect_err("one end");
    let place = "over_seeds.scores[0].interval";
    assert!(error.to_string().starts_with(place), "{error}");
}

#[test]
fn every_metric_of_a_comparison_is_linked_to_its_meaning() {
    let studies = [drawn("one", 30, 1.0), drawn("two", 30, 1.5)];
    let page = compare(&studies, &CompareRequest::default()).page(&studies);
    for link in page.split("href=\"#metric-").skip(1) {
        let (id, _) = link.split_once('"').expect("its end");
        assert!(page.contains(&format!("id=\"metric-{id}\"")), "{id}");
    }
    assert!(page.matches("href=\"#metric-mae\"").count() > 3);
}
