//! Tests of verdicts in words: ties, light, labels and the lines of a first screen.

use crate::support;
use serde_json::{Value, json};
use taceva_metrics::Standing;
use taceva_report::{
    CompareRequest, Comparison, LimitsFile, Need, OVERVIEW_LINES, OVERVIEW_WIDTH, ReportPage,
    ScoreTable, Study, accept, choose_results, compare, figures, limits_template, report,
};

/// Synthetic studies, each modified by `change`.
fn studies(names: &[&str], change: impl Fn(usize, &mut Value)) -> Vec<Study> {
    let mut all = Vec::new();
    for (at, name) in names.iter().enumerate() {
        // A factor of two between neighbours, so that differences are significant.
        let mut result = support::results(name, 2.0_f64.powi(i32::try_from(at).expect("few")));
        change(at, &mut result["metrics"]);
        all.extend(support::read(&result).expect("a result"));
    }
    all
}

fn compared(studies: &[Study]) -> Comparison {
    compare(studies, &CompareRequest::default())
}

/// First verdicts of the page, without markup.
fn summary(studies: &[Study]) -> String {
    let page = report(&ReportPage {
        title: "drawn",
        studies,
        pictures: &[],
        triples: &[],
    });
    let list = page
        .split("<ul class=\"verdicts\">")
        .nth(1)
        .expect("a list");
    let list = list.split("</ul>").next().expect("its end");
    let parts = list.split('<').map(|part| match part.split_once('>') {
        Some((_, words)) => words,
        None => part,
    });
    parts.collect()
}

#[test]
fn scores_of_the_same_bits_are_a_tie_on_the_page_in_the_overview_and_in_json() {
    let same = |_: usize, metrics: &mut Value| metrics["uniformity"]["Fz"]["value"] = json!(0.9);
    let studies = studies(&["one", "two"], same);
    let tie = "tie: one and two have the same value, 0.9";
    let page = summary(&studies);
    assert!(page.contains(tie), "{page}");
    let comparison = compared(&studies);
    for text in [comparison.text(), comparison.page(&studies)] {
        assert!(text.contains(tie), "{text}");
    }
    let json: Value = serde_json::from_str(&comparison.json()).expect("JSON");
    let decisions = json["decisions"].as_array().expect("decisions");
    let of = |metric: &str| {
        let mut found = decisions.iter();
        found.find(|of| of["metric"] == metric).expect("asked")
    };
    assert_eq!(of("uniformity")["tied"], json!(["one", "two"]));
    assert_eq!(of("uniformity")["winner"], Value::Null);
    assert_eq!(of("mae")["tied"], json!([]));
    assert_eq!(json["schema"], "taceva.comparison/2.1");
}

#[test]
fn a_score_in_too_little_light_is_never_called_the_best() {
    let studies = studies(&["dim", "lit", "lamp"], |at, metrics| {
        if at == 0 {
            metrics["r_light"]["Fz"]["flags"] = json!(["low stimulus"]);
            metrics["r_light"]["Fz"]["scenes"]["values"] = json!([[0.99991, 1.25], [1.1, 22.0]]);
        }
    });
    let page = summary(&studies);
    for words in [
        "dim: errors of unbounded predictions become 1.25 to 22 times as large in the lit scenes; light changed by 0.009 % to 10 %: stimulus hardly changed in at least one scene.",
        "lit is shown to be better than every other sensor that takes part",
        "Excluded from verdicts: dim (stimulus hardly changed).",
    ] {
        assert!(page.contains(words), "{words}: {page}");
    }
    let comparison = compared(&studies);
    let decisions = comparison.decisions();
    let light = decisions.iter().find(|of| of.metric == "r_light");
    let light = light.expect("asked");
    assert_eq!(light.winner, Some(1), "{}", light.words);
    let won = comparison
        .answers
        .iter()
        .filter(|of| of.metric == "r_light");
    let mut won = won.filter(|of| of.channel == "Fz" && of.sides.a == 0);
    assert!(won.all(|answer| answer.better().is_none()));
    let low =
        "; dim: light changed by 0.009 % to 10 %: stimulus hardly changed in at least one scene";
    assert!(light.words.ends_with(low), "{}", light.words);
}

#[test]
fn what_light_does_is_said_of_a_score_that_is_barred_as_bounded() {
    let mut studies = studies(&["lit", "other"], |at, metrics| {
        if at == 0 {
            metrics["r_light"]["Fz"]["scenes"]["values"] = json!([[1.4, 66.0], [2.8, 325.0]]);
        }
    });
    for score in &mut studies[0].scores {
        if score.metric == "mae" {
            score.standing = Standing::Bounded;
        }
    }
    let page = summary(&studies);
    let words =
        "lit: errors of unbounded predictions become 66 to 325 times as large in the lit scenes.";
    assert!(page.contains(words), "{page}");
    assert!(
        page.contains("lit (predictions beyond the trained range)"),
        "{page}"
    );
}

#[test]
fn the_figure_of_light_draws_ratios_of_the_scores_and_nothing_from_samples_alone() {
    let find = |studies: &[Study]| {
        let mut all = figures(studies).into_iter();
        all.rfind(|figure| figure.id == "lighting")
    };
    let mut lit = support::drawn("one", 60, 1.0);
    let figure = find(std::slice::from_ref(&lit)).expect("a figure");
    let said = figure.svg();
    let words = "one, scene S2: error 8 times that in unchanged light, light 2.3 times";
    assert!(said.contains(words), "{said}");
    assert!(
        figure
            .caption
            .contains("not clipped to the bounds of the model")
    );
    for score in &mut lit.scores {
        score.variants.retain(|variant| variant.name != "scenes");
    }
    assert!(find(&[lit]).is_none());
}

#[test]
fn errors_of_labels_that_spread_differently_are_said_to_be() {
    let studies = studies(&["one", "two", "three"], |at, metrics| {
        let (rmse, skill) = [(0.012, 0.91), (0.02, 0.84), (0.136, 0.36)][at];
        metrics["rmse"]["Fxy"] = json!({"value": rmse, "unit": "N"});
        for axis in ["Fx", "Fy"] {
            metrics["rmse"][axis] = json!({"value": rmse, "unit": "N"});
            metrics["r2"][axis] = json!({"value": skill, "unit": "1"});
        }
    });
    let words = "(their labels differ in spread: one 0.04 N to three 0.17 N)";
    let page = summary(&studies);
    assert_eq!(page.matches(words).count(), 1, "{page}");
    assert!(
        compared(&studies)
            .text()
            .replace("\n     ", "")
            .contains(words)
    );
    let overview = compared(&studies).overview(None);
    let line = overview.lines().find(|line| line.contains("mae Fxy"));
    assert!(line.is_some_and(|line| line.contains(words)), "{overview}");
}

#[test]
fn a_tie_says_whom_those_that_share_the_value_are_not_shown_to_be_better_than() {
    // The tied studies have the best value of three. The third is within all intervals, the fourth far away.
    let values = [0.9, 0.9, 0.89, 0.5];
    let studies = studies(&["one", "two", "near", "far"], |at, metrics| {
        let value = values[at];
        metrics["uniformity"]["Fz"]["value"] = json!(value);
        metrics["uniformity"]["Fz"]["ci95"] = json!([value - 0.02, value + 0.02]);
    });
    let words = "; neither is shown to be better than near";
    let page = summary(&studies);
    assert!(page.contains(words), "{page}");
    let comparison = compared(&studies);
    let of = comparison.decisions();
    let of = of
        .iter()
        .find(|of| of.metric == "uniformity")
        .expect("asked");
    assert!(of.words.ends_with(words), "{}", of.words);
    let alone = compared(&studies[..2]);
    assert!(!alone.text().contains("neither"), "{}", alone.text());
}

#[test]
fn tables_name_the_channels_whose_labels_differ_in_spread() {
    let studies = studies(&["one", "two"], |at, metrics| {
        let (rmse, skill) = [(0.012, 0.91), (0.136, 0.36)][at];
        metrics["rmse"]["Fxy"] = json!({"value": rmse, "unit": "N"});
        for axis in ["Fx", "Fy"] {
            metrics["rmse"][axis] = json!({"value": rmse, "unit": "N"});
            metrics["r2"][axis] = json!({"value": skill, "unit": "1"});
        }
    });
    let table = ScoreTable::of(&studies);
    let words = "Fxy: one 0.04 N to two 0.17 N";
    for table in [table.for_pages(), table.for_papers("drawn")] {
        let text = table.text();
        assert!(text.contains(words), "{text}");
    }
    let column = table.for_column("drawn").remove(0).text();
    assert!(column.contains("labels of the sensors differ"), "{column}");
    let alike = ScoreTable::of(&studies[..1]).for_pages().text();
    assert!(!alike.contains("Labels differ"), "{alike}");
}

#[test]
fn a_value_that_takes_no_part_is_marked_where_a_column_has_no_room_for_the_reason() {
    let mut studies = studies(&["lit", "other"], |_, _| ());
    for score in &mut studies[0].scores {
        if score.metric == "mae" {
            score.standing = Standing::Bounded;
        }
    }
    let table = ScoreTable::of(&studies).for_column("drawn").remove(0);
    let row = table
        .rows
        .iter()
        .find(|row| row.plain()[0].starts_with("mae Fz"));
    let row = row.expect("a row").plain();
    assert!(row[1].contains('†') && !row[2].contains('†'), "{row:?}");
    let note = "†: takes no part in verdicts (predictions beyond the trained range).";
    assert!(table.text().contains(note), "{}", table.text());
}

#[test]
fn a_choice_by_values_alone_says_that_no_test_shows_the_difference() {
    let needs = Need::parse("soft contact").expect("needs");
    let of = |values: [f64; 2]| {
        let studies = studies(&["one", "two"], |at, metrics| {
            let value = values[at];
            metrics["sensitivity"]["Fz"]["value"] = json!(value);
            metrics["sensitivity"]["Fz"]["ci95"] = json!([value - 0.2, value + 0.2]);
        });
        choose_results(&studies, &needs)
    };
    let near = of([2.5, 2.4]);
    let headline = "one first, two second, by values only: no test shows one to be better than two";
    assert_eq!(near.headline(), headline);
    let text = near.table().text();
    assert!(text.contains("2.3 … 2.7"), "{text}");
    let note = "Tests: one is not shown to be better than two in any of these numbers.";
    assert!(text.contains(note), "{text}");
    let far = of([2.5, 0.5]);
    assert_eq!(far.headline(), "one first, two second");
    let shown = far.evidence.as_deref().expect("tested");
    assert_eq!(
        (shown[0].better.as_str(), shown[0].than.as_str()),
        ("one", "two")
    );
    assert!(shown[0].p < 0.05);
    assert!(
        far.table()
            .text()
            .contains("Tests: one is shown to be better than two in sensitivity (p ")
    );
    assert!(far.json().contains("\"p_holm\""));
}

#[test]
fn skill_that_was_shown_on_one_table_of_truth_was_shown_on_the_same_samples() {
    let note = |truths: [&str; 2]| {
        let mut studies = studies(&["one", "two"], |_, metrics| {
            metrics["skill"]["Fz"] = json!({"value": 0.9, "unit": "1", "n": 80});
        });
        for (number, (study, truth)) in studies.iter_mut().zip(truths).enumerate() {
            let tables = format!("prediction sha256:p{number}, truth {truth}");
            study.provenance = vec![("tables".to_owned(), tables)];
            study.made.truth = Some(truth.to_owned());
        }
        let mut notes = compared(&studies).notes.into_iter();
        notes.find(|note| note.starts_with("skill was measured on different test parts"))
    };
    assert_eq!(note(["sha256:1", "sha256:1"]), None);
    let apart = note(["sha256:1", "sha256:2"]).expect("two truths");
    assert!(apart.contains("of the truth sha256:2"), "{apart}");
}

#[test]
fn questions_without_room_are_counted_and_no_line_is_cut_away_from_a_terminal() {
    let long = "a sensor with a name that is much longer than any that a line has room for";
    let mut studies = studies(&["one", long], |_, _| ());
    let provenance = |seed: &str| vec![("seed".to_owned(), seed.to_owned())];
    for (study, seed) in studies.iter_mut().zip(["1", "2"]) {
        study.provenance = provenance(seed);
    }
    let comparison = compared(&studies);
    let asked = comparison.decisions().len();
    assert_eq!(asked, 10);
    let whole = comparison.overview(None);
    assert!(!whole.contains('…'), "{whole}");
    let lines: Vec<&str> = whole.lines().collect();
    assert!(lines.len() <= OVERVIEW_LINES, "{whole}");
    let shown = lines
        .iter()
        .filter(|line| line.contains(" ↓): ") || line.contains(" ↑): "));
    let more = asked - shown.count();
    let last = format!("{more} more question");
    assert!(more > 0 && lines.last().is_some_and(|line| line.starts_with(&last)));
    assert!(whole.ends_with(": --all\n"), "{whole}");
    for line in comparison.overview(Some(OVERVIEW_WIDTH)).lines() {
        assert!(line.chars().count() <= OVERVIEW_WIDTH, "{line}");
    }
    let (all, page) = (comparison.text(), comparison.page(&studies));
    for decision in comparison.decisions() {
        assert!(all.contains(&decision.asked()), "{}", decision.question);
        assert!(page.contains(&format!("<strong>{}</strong>", decision.question)));
    }
}

#[test]
fn a_radar_places_nothing_without_an_interval_or_of_light_that_hardly_changed() {
    let names = ["dim", "other"];
    let undefined = json!({"undefined": "1 cluster, 5 are needed"});
    let studies = studies(&names, |at, metrics| {
        metrics["uniformity"]["Fz"]["ci95"] = undefined.clone();
        metrics["signal_to_repeatability"] = metrics["hysteresis"].clone();
        if at == 0 {
            metrics["r_light"]["Fz"]["flags"] = json!(["low stimulus"]);
        }
    });
    let drawn = figures(&studies);
    let caption = |id: &str| {
        let figure = drawn.iter().find(|figure| figure.id == id);
        figure.expect("a radar").caption.clone()
    };
    let sensor = caption("radar-sensor");
    for name in names {
        let missing = format!("uniformity U of {name} (no interval)");
        assert!(sensor.contains(&missing), "{sensor}");
    }
    let robustness = caption("radar-robustness");
    assert!(
        robustness.contains("lighting Fz of dim (stimulus hardly changed)"),
        "{robustness}"
    );
    assert!(!robustness.contains("lighting Fz of other"), "{robustness}");
}

#[test]
fn a_limit_on_light_that_hardly_changed_is_not_kept_and_no_template_has_one() {
    let studies = studies(&["dim"], |_, metrics| {
        metrics["r_light"]["Fz"]["flags"] = json!(["low stimulus"]);
    });
    let text = "limits_version = 1\n[[limit]]\nmetric=\"r_light\"\nchannel=\"Fz\"\nunit=\"1\"\nleast=0.0\n";
    let limits = LimitsFile::read(text).expect("limits");
    let found = accept(&studies[0], &limits).expect("checks");
    let reason = found[0].reason.as_deref();
    assert!(
        reason.is_some_and(|reason| reason.starts_with("stimulus hardly changed: ")),
        "{reason:?}"
    );
    let template = limits_template(&studies[0]);
    assert!(template.contains("stimulus hardly changed"), "{template}");
}
