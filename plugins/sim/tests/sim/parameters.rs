//! Rejected parameter tables, each with its line and the expected value, and differences that a digest detects.

use taceva_sim::{Model, Origin, ParameterErrorKind, Parameters};

/// Message for the GelSight table with `from` replaced by `to`.
fn refused(from: &str, to: &str) -> String {
    let table = Model::GelSight.table();
    assert!(table.contains(from), "{from}");
    let error = Parameters::parse(&table.replacen(from, to, 1)).expect_err(to);
    error.to_string()
}

fn line_of(words: &str) -> usize {
    let table = Model::GelSight.table();
    1 + table
        .lines()
        .position(|line| line.contains(words))
        .expect(words)
}

#[test]
fn text_that_is_no_toml_is_refused_with_its_line() {
    let error = Parameters::parse("name = \"x\"\n[layer\n").expect_err("no TOML");
    assert_eq!(error.line(), 2);
    assert!(matches!(error.kind(), ParameterErrorKind::Syntax { .. }));
}

#[test]
fn an_empty_table_says_what_is_missing() {
    let error = Parameters::parse("").expect_err("empty").to_string();
    assert_eq!(
        error,
        "line 1: `name`: missing, expected the name of the sensor, a string"
    );
}

#[test]
fn an_unknown_key_is_refused_with_the_nearest_one() {
    let line = line_of("thickness_mm");
    assert_eq!(
        refused("thickness_mm", "thikness_mm"),
        format!("line {line}: `layer.thikness_mm`: unknown key, did you mean `thickness_mm`?")
    );
}

#[test]
fn an_unknown_section_is_refused_with_the_nearest_one() {
    let message = refused("[robot]", "[robots]");
    // Missing sections are reported first, and this table has no `robot`.
    assert!(
        message.contains("`robot`: missing, expected a section of this name"),
        "{message}"
    );
    let table = format!("{}\n[lamps]\n", Model::GelSight.table());
    let error = Parameters::parse(&table).expect_err("lamps").to_string();
    assert!(error.ends_with("`lamps`: unknown section"), "{error}");
}

#[test]
fn an_unknown_part_of_a_number_is_refused() {
    let message = refused("origin = \"geometric\"", "orign = \"geometric\"");
    assert!(
        message.contains(".orign`: unknown part, did you mean `origin`?"),
        "{message}"
    );
}

#[test]
fn a_missing_key_is_named_with_its_form() {
    let table: String = Model::GelSight
        .table()
        .lines()
        .filter(|line| !line.starts_with("young_modulus_mpa"))
        .map(|line| format!("{line}\n"))
        .collect();
    let error = Parameters::parse(&table).expect_err("missing");
    assert_eq!(error.line(), line_of("[layer]"));
    let expected =
        "`layer.young_modulus_mpa`: missing, expected { value = 0.001 to 100, unit = \"MPa\"";
    assert!(error.to_string().contains(expected), "{error}");
}

#[test]
fn a_number_outside_its_range_is_refused_with_the_range() {
    let line = line_of("thickness_mm");
    assert_eq!(
        refused("value = 4.25", "value = -4.25"),
        format!("line {line}: `layer.thickness_mm`: found -4.25, expected 1 to 100 mm")
    );
    for not_finite in ["nan", "inf", "-inf", "1e999"] {
        let message = refused("value = 4.25", &format!("value = {not_finite}"));
        assert!(message.contains("expected 1 to 100 mm"), "{message}");
    }
}

#[test]
fn another_unit_than_the_declared_one_is_refused() {
    let line = line_of("thickness_mm");
    assert_eq!(
        refused("value = 4.25, unit = \"mm\"", "value = 4.25, unit = \"m\""),
        format!("line {line}: `layer.thickness_mm`: found \"m\", expected the unit \"mm\"")
    );
}

#[test]
fn an_unknown_origin_is_refused_with_those_that_are_known() {
    let message = refused("origin = \"geometric\"", "origin = \"guess\"");
    assert!(
        message.ends_with("found \"guess\", expected one of geometric, literature, fit, free"),
        "{message}"
    );
}

#[test]
fn a_value_of_another_type_is_refused() {
    let message = refused("value = 4.25", "value = \"4.25\"");
    assert!(
        message.ends_with("found \"4.25\", expected a decimal number"),
        "{message}"
    );
    let message = refused("name = \"GelSight\"", "name = 3");
    assert!(message.ends_with("`name`: found 3, expected the name of the sensor, a string"));
    let bare = refused(
        "thickness_mm = { value = 4.25, unit = \"mm\", origin = \"geometric\" }",
        "thickness_mm = 4.25",
    );
    assert!(
        bare.contains("`layer.thickness_mm`: found 4.25, expected { value ="),
        "{bare}"
    );
}

#[test]
fn two_bodies_or_none_are_refused() {
    let dome = Model::ViTacTip.table();
    let start = dome.find("[dome]").expect("a dome");
    let end = dome.find("[surface]").expect("a surface");
    let both = format!("{}\n{}", Model::GelSight.table(), &dome[start..end]);
    let error = Parameters::parse(&both).expect_err("two").to_string();
    assert!(
        error.contains("found a second body, expected either `layer` or `dome`"),
        "{error}"
    );
    let none = format!("{}{}", &dome[..start], &dome[end..]);
    let error = Parameters::parse(&none).expect_err("none").to_string();
    assert!(error.contains("`layer`: missing"), "{error}");
}

#[test]
fn a_depth_beyond_what_the_force_law_holds_for_is_refused() {
    let message = refused(
        "depth_max_mm = { value = 1.0",
        "depth_max_mm = { value = 3.0",
    );
    let line = line_of("depth_max_mm");
    assert!(
        message.starts_with(&format!("line {line}: `probing.depth_max_mm`: found 3")),
        "{message}"
    );
    assert!(message.contains("expected at most 2.601"), "{message}");
    let message = refused(
        "depth_min_mm = { value = 0.1",
        "depth_min_mm = { value = 1.0",
    );
    assert!(
        message.contains("expected below depth_max_mm = 1"),
        "{message}"
    );
}

#[test]
fn a_table_that_is_far_too_long_is_not_even_read() {
    let error = Parameters::parse(&"#".repeat(2 << 20))
        .expect_err("long")
        .to_string();
    assert!(
        error.contains("2097152 bytes, expected at most 1048576"),
        "{error}"
    );
}

#[test]
fn the_digest_tells_numbers_and_origins_apart_and_nothing_else() {
    let table = Model::GelSight.table();
    let digest = |table: &str| {
        Parameters::parse(table)
            .expect("a table")
            .digest()
            .to_string()
    };
    let plain = digest(table);
    assert_eq!(plain.len(), 64);
    assert_eq!(plain, digest(&format!("# remark\n{table}")));
    assert_eq!(
        plain,
        digest(&table.replacen("value = 4.25", "value = 4.2500", 1))
    );
    assert_ne!(
        plain,
        digest(&table.replacen("value = 4.25", "value = 4.26", 1))
    );
    let elsewhere = table.replacen("origin = \"geometric\"", "origin = \"free\"", 1);
    assert_ne!(plain, digest(&elsewhere));
}

#[test]
fn every_number_knows_its_line_unit_and_origin() {
    let parameters = Model::GelSight.parameters();
    let thickness = parameters
        .entries()
        .iter()
        .find(|entry| entry.key == "thickness_mm")
        .expect("a thickness");
    assert_eq!(
        (thickness.unit, thickness.origin),
        ("mm", Origin::Geometric)
    );
    assert_eq!(thickness.line, line_of("thickness_mm"));
}

#[test]
fn the_report_on_the_bench_is_about_these_parameters() {
    let report = include_str!("../../../../docs/validation.md");
    for model in Model::ALL {
        let digest = model.parameters().digest().to_string();
        assert!(report.contains(&digest), "{model}: {digest}");
    }
}
