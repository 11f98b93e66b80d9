//! Tests of choices among the catalogue and among results.

use super::*;
use crate::Study;
use crate::catalogue;
use crate::faults::tests::{drawn, without_skill};

/// Names of the four sensors of the TacEva study, ranked for `needs`.
fn ranked(needs: &str) -> Vec<String> {
    let needs = Need::parse(needs).unwrap_or_else(|error| panic!("{error}"));
    let of_study = ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"];
    let of_study = of_study.map(|name| catalogue::find(name).expect("there"));
    let choice = choose(&of_study, &needs);
    choice
        .ranked
        .into_iter()
        .map(|candidate| candidate.name)
        .collect()
}

#[test]
fn the_guidance_of_the_study_comes_out() {
    for (needs, expected) in [
        ("deep contact, normal force", "ViTacTip"),
        ("soft contact, normal force", "ViTacTip"),
        ("shallow contact, depth", "GelSight"),
        ("firm contact, depth", "GelSight"),
        ("shallow contact, planar, fast", "MagicTac"),
        ("firm contact, planar, fast", "MagicTac"),
        ("accurate shear", "ViTacTip"),
        ("no shear", "GelSightWM"),
    ] {
        assert_eq!(ranked(needs)[0], expected, "{needs}");
    }
    assert_eq!(
        ranked("accurate shear, ambient light"),
        ["GelSight", "GelSightWM"]
    );
}

#[test]
fn results_of_a_sensor_are_held_to_what_it_is_known_to_stand() {
    let named = |name: &str| {
        let study = crate::Study {
            sensor: name.to_owned(),
            scores: catalogue::find("ViTacTip")
                .expect("there")
                .as_study()
                .scores,
            ..crate::Study::default()
        };
        Sensor::of_study(&study)
    };
    let needs = Need::parse("normal force, force 1 N").expect("needs");
    let choice = choose(
        &[named("ViTacTip"), named("MagicTac"), named("mine")],
        &needs,
    );
    let names: Vec<&str> = choice
        .ranked
        .iter()
        .map(|candidate| candidate.name.as_str())
        .collect();
    assert_eq!(names, ["MagicTac"]);
    let [tried, mine] = choice.open.as_slice() else {
        panic!("{:?}", choice.open);
    };
    let reason = "its greatest normal force that was tested is 0.7 N, which need not be its limit";
    assert!(tried.reason.contains(reason), "{tried:?}");
    assert_eq!(mine.name, "mine");
    assert!(mine.reason.contains("not known"), "{mine:?}");
}

#[test]
fn what_a_real_sensor_stands_is_not_known_of_a_simulated_one_and_said_to_be_of_the_catalogue() {
    let study = |source: &str| crate::Study {
        sensor: "MagicTac".to_owned(),
        source: source.to_owned(),
        scores: catalogue::find("MagicTac")
            .expect("there")
            .as_study()
            .scores,
        ..crate::Study::default()
    };
    let needs = Need::parse("normal force, force 1 N, even surface").expect("needs");
    let simulated = choose_results(&[study("simulated")], &needs);
    assert_eq!(simulated.open.len(), 1, "{simulated:?}");
    assert!(simulated.limits_of_catalogue.is_empty());
    let mut measured = study("recorded");
    measured.scores.retain(|score| score.metric != "uniformity");
    let without = choose_results(std::slice::from_ref(&measured), &needs);
    assert_eq!(without.unplaced[0].reason, "no known uniformity");
    let needs = Need::parse("depth, force 1 N").expect("needs");
    let text = |study: &crate::Study| {
        let choice = choose_results(std::slice::from_ref(study), &needs);
        choice.table().text()
    };
    let limits =
        "Greatest depth and force are from the catalogue, not from these results: MagicTac.";
    assert!(text(&measured).contains(limits), "{}", text(&measured));
    measured
        .scores
        .retain(|score| score.metric != "repeatability");
    let unknown = "Not ranked, no known repeatability of Pz: MagicTac.";
    assert!(text(&measured).contains(unknown), "{}", text(&measured));
}

#[test]
fn rugged_ranks_by_degradation_and_the_end_of_skill_and_names_untested_sensors() {
    let needs = Need::parse("rugged").expect("a need");
    let study = |name: &str, list: &str, mean: f64| Study::of_faults(drawn(name, list, mean));
    let untested = Study {
        sensor: "plain".to_owned(),
        ..Study::default()
    };
    let studies = [
        study("weak", "gel-12", 8.0),
        study("strong", "gel-12", 2.0),
        study("other", "tear", 1.1),
        untested,
    ];
    let choice = choose_results(&studies, &needs);
    let names: Vec<&str> = choice.ranked.iter().map(|of| of.name.as_str()).collect();
    assert_eq!(names, ["strong", "weak"]);
    let steps = &choice.ranked[0].steps;
    assert_eq!(steps[0].value, Some(2.0));
    assert!(steps[0].interval.is_some());
    assert_eq!(
        steps[1].value,
        Some(3.0),
        "the severity at which skill ends"
    );
    let [apart] = choice.apart.as_slice() else {
        panic!("{:?}", choice.apart);
    };
    assert_eq!(apart.name, "other");
    assert!(apart.reason.contains("its faults are `tear`"), "{apart:?}");
    assert_eq!(choice.unknown, ["plain"]);
}

#[test]
fn faults_of_a_model_without_skill_rank_no_sensor() {
    let needs = Need::parse("rugged").expect("a need");
    let studies = [Study::of_faults(without_skill("constant"))];
    let choice = choose_results(&studies, &needs);
    assert!(choice.ranked.is_empty(), "{choice:?}");
    assert_eq!(choice.barred[0].name, "constant");
}

#[test]
fn an_error_in_the_plane_is_said_to_be_no_distance() {
    let noted = |words: &str| {
        let choice = choose(&catalogue::all(), &Need::parse(words).expect("needs"));
        choice.table().text().contains("the mean of both axes")
    };
    assert!(noted("localisation 0.3 mm, shear"));
    assert!(!noted("normal force"));
}

#[test]
fn a_sensor_without_a_number_for_a_need_that_ranks_has_no_place() {
    let choice = choose(
        &catalogue::all(),
        &Need::parse("shear, rate >= 100 Hz").expect("needs"),
    );
    let mut of_ranked = choice.ranked.iter().flat_map(|candidate| &candidate.steps);
    assert!(of_ranked.all(|step| step.value.is_some()));
    let unplaced: Vec<&str> = choice.unplaced.iter().map(|of| of.name.as_str()).collect();
    assert!(!unplaced.is_empty(), "{choice:?}");
    assert_eq!(choice.unplaced[0].reason, "no known MAE of Fxy");
    let place = |name: &str| {
        let table = choice.values();
        let mut rows = table.rows.iter().map(|row| row.plain());
        rows.find(|row| row[0] == name).expect("a row")[1].clone()
    };
    assert_eq!(place(unplaced[0]), "not ranked");
    assert!(!choice.headline().contains("tie for first"), "{choice:?}");
    let text = choice.table().text();
    assert!(text.contains("Not ranked, no known MAE of Fxy: "), "{text}");
    let only: Vec<Sensor> = unplaced
        .iter()
        .map(|name| catalogue::find(name).expect("there"))
        .collect();
    let choice = choose(&only, &Need::parse("shear, rate >= 100 Hz").expect("needs"));
    assert!(
        choice.headline().starts_with("No sensor is ranked: "),
        "{}",
        choice.headline()
    );
    assert!(choice.headline().contains(unplaced[0]));
}

#[test]
fn the_depth_is_chosen_by_the_excess_of_the_variation_between_places() {
    use taceva_core::Unit;
    use taceva_results::{Score, Value, Variant};

    let measured = |name: &str, spatial: f64, excess: Option<f64>| {
        let score = |metric: &str, value: f64| Score {
            definition: format!("{metric}/2"),
            ..Score::of_number(metric, "Pz", value, Unit::Millimetre)
        };
        let variant = |value: f64| Variant {
            name: "excess".to_owned(),
            value: Value::Number(value),
            unit: Unit::Millimetre,
            interval: None,
        };
        let spatial = Score {
            variants: excess.into_iter().map(variant).collect(),
            ..score("r_spatial", spatial)
        };
        crate::Study {
            sensor: name.to_owned(),
            scores: vec![score("mae", 0.1), score("repeatability", 0.1), spatial],
            ..crate::Study::default()
        }
    };
    let needs = Need::parse("depth").expect("needs");
    let first = |studies: [crate::Study; 2]| {
        let choice = choose_results(&studies, &needs);
        let ranked = choice.ranked.iter();
        let names: Vec<&str> = ranked.map(|one| one.name.as_str()).collect();
        assert_eq!(names.len(), 2, "{choice:?}");
        let mut variants = studies[0].scores.iter().flat_map(|score| &score.variants);
        let named = "spatial robustness of Pz: the variant excess, which verdicts use.";
        let text = choice.table().text();
        assert_eq!(text.contains(named), variants.next().is_some(), "{text}");
        let spatial = choice.ranked[0].steps.last().and_then(|step| step.value);
        (names[0].to_owned(), spatial)
    };
    // A sensor with few samples for each bin varies more by chance.
    let few = measured("few samples", 0.2, Some(0.03));
    let many = measured("many samples", 0.1, Some(0.06));
    assert_eq!(first([many, few]), ("few samples".to_owned(), Some(0.03)));
    let older = [
        measured("few samples", 0.2, None),
        measured("many samples", 0.1, None),
    ];
    assert_eq!(first(older), ("many samples".to_owned(), Some(0.1)));
}

#[test]
fn no_study_of_sensors_is_ever_chosen_or_set_aside() {
    let choice = choose(&catalogue::all(), &Need::parse("fast").expect("a need"));
    let listed = format!("{choice:?}");
    for study in ["Eval", "Sparsh", "TacEva", "VT-Review", "PBR-Design"] {
        assert!(!listed.contains(&format!("\"{study}\"")), "{study}");
    }
}

#[test]
fn what_no_sensor_meets_says_who_fails_by_which_number() {
    let needs =
        Need::parse("shear, force <= 1 N, ambient light, rate >= 50 Hz, localisation 0.3 mm")
            .expect("needs");
    let choice = choose(&catalogue::all(), &needs);
    assert!(choice.ranked.is_empty());
    let gelsight = choice
        .dropped
        .iter()
        .find(|dropped| dropped.name == "GelSight")
        .expect("dropped");
    assert_eq!(gelsight.reason, "`rate >= 50 Hz`: its frame rate is 25 Hz");
    assert!(choice.unknown.contains(&"GelForce".to_owned()));
    let digit = choice.open.iter().find(|open| open.name == "DIGIT");
    let reason = &digit.expect("its rate is known, and no more").reason;
    assert!(
        reason.contains("greatest normal force is not known"),
        "{reason}"
    );
}

/// Choice for `needs` among the whole catalogue.
fn chosen(needs: &str) -> Choice {
    let needs = Need::parse(needs).unwrap_or_else(|error| panic!("{error}"));
    choose(&catalogue::all(), &needs)
}

/// Reason of the sensor called `name` in a list of sensors without a rank.
fn reason<'a>(list: &'a [Dropped], name: &str) -> &'a str {
    let found = list.iter().find(|of| of.name == name);
    &found
        .unwrap_or_else(|| panic!("no {name}: {list:?}"))
        .reason
}

#[test]
fn a_thickness_of_the_gel_or_without_a_definition_ranks_no_sensor_by_its_thickness() {
    let choice = chosen("thin");
    let ranked: Vec<&str> = choice.ranked.iter().map(|of| of.name.as_str()).collect();
    assert!(ranked.contains(&"PaXini DP-S1813-Elite"), "{ranked:?}");
    for name in ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"] {
        assert!(!ranked.contains(&name), "{name}");
        assert!(!choice.unknown.contains(&name.to_owned()), "{name}");
    }
    let gel = reason(&choice.other_definitions, "GelSight");
    assert!(
        gel.contains("gel_thickness gel 4.25 mm (thickness of the gel)"),
        "{gel}"
    );
    let unstated = reason(&choice.other_definitions, "ViTacTip");
    assert!(
        unstated.contains("50 mm (definition not stated by the source)"),
        "{unstated}"
    );
    assert_eq!(chosen("gel thickness <= 5 mm").ranked[0].name, "Evetac");
}

#[test]
fn a_number_of_another_definition_is_shown_and_neither_meets_a_bound_nor_is_called_unknown() {
    let choice = chosen("force error <= 0.1 N");
    let minsight = reason(&choice.other_definitions, "Minsight");
    assert!(
        minsight.contains("force_error F 0.07 N (mean absolute error"),
        "{minsight}"
    );
    let insight = reason(&choice.other_definitions, "InSight");
    assert!(insight.contains("≈ 0.03 N"), "{insight}");
    let text = choice.table().text();
    assert!(
        text.contains("Minsight: no MAE of Fz; known: force_error F 0.07 N"),
        "{text}"
    );
    assert!(
        text.contains("a number of another definition only"),
        "{text}"
    );
    let json: serde_json::Value = serde_json::from_str(&choice.json()).expect("json");
    let names = json["other_definitions"].as_array().expect("a list");
    assert!(names.iter().any(|of| of["name"] == "Minsight"), "{json}");
    let range = chosen("force >= 5 N");
    let paxini = reason(&range.other_definitions, "PaXini DP-S1813-Elite");
    assert!(paxini.contains("force_range Fz 25 N"), "{paxini}");
    let both = chosen("force error <= 0.1 N, rate >= 30 Hz");
    let open = both.open.iter().find(|open| open.name == "Minsight");
    let open = &open.expect("its rate is known").reason;
    assert!(
        open.contains("is not known; known: force_error F 0.07 N"),
        "{open}"
    );
}

#[test]
fn widths_sizes_prices_and_sellers_are_bounds_and_what_is_unknown_is_open() {
    let names = |choice: &Choice| -> Vec<String> {
        choice.ranked.iter().map(|of| of.name.clone()).collect()
    };
    let narrow = chosen("width <= 20 mm, size <= 30 mm");
    assert!(
        names(&narrow).contains(&"DIGIT".to_owned()),
        "{:?}",
        names(&narrow)
    );
    let dropped = reason(&narrow.dropped, "9DTact");
    assert!(
        dropped.contains("its middle dimension is 25.5 mm"),
        "{dropped}"
    );
    let open = narrow.open.iter().find(|open| open.name == "DIGIT Pinki");
    let open = &open.expect("its length is unknown").reason;
    assert!(
        open.contains("greatest dimension is not known; known: 15 mm"),
        "{open}"
    );
    let text = narrow.table().text();
    assert!(
        text.contains("DIGIT, middle dimension: 20 × 27 × 18 mm, housing."),
        "{text}"
    );
    assert!(!text.contains("mean share"), "nothing ranks: {text}");
    let cheap = chosen("price <= 600 USD, can be bought");
    assert_eq!(names(&cheap), ["GelSight", "GelSightWM"]);
    let open = |name: &str| {
        let found = cheap.open.iter().find(|open| open.name == name);
        found
            .unwrap_or_else(|| panic!("{name} is open"))
            .reason
            .clone()
    };
    assert!(open("DIGIT").contains("known: 15 USD (parts of one sensor, of 1000 made)"));
    assert!(open("PaXini DP-S2015-Elite").contains("name the bound in KRW"));
    let built = chosen("bought, price <= 600 USD, width <= 50 mm");
    let open = built.open.iter().find(|open| open.name == "R-Tac0");
    assert!(open.expect("it is built").reason.contains("needs a seller"));
}

#[test]
fn published_errors_state_the_greatest_tested_depth_and_force() {
    let text = chosen("force error <= 0.1 N").table().text();
    let tested = "GelSight 1 mm, 1.83 N; GelSightWM 1 mm, 1.83 N; ";
    assert!(text.contains(tested), "{text}");
    let text = chosen("rate >= 1 Hz").table().text();
    assert!(!text.contains("Published errors"), "{text}");
}
