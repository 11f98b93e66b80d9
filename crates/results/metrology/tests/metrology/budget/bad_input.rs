//! Invalid budget files: each error states line, key and expectation.

use taceva_core::Coverage;
use taceva_metrology::budget::{BudgetText, Certificate, Evidence};

use super::overlaps::figures;
use super::{budgets, refusal};

/// Error message for a budget of one source.
fn source(keys: &str) -> String {
    let text = format!(
        "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"a\"\n{keys}\n"
    );
    refusal(&text, &Evidence::default())
}

/// Error message for an expression over a = 4 and b = 0.
fn expression(text: &str) -> String {
    let text = format!(
        "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"{text}\"\n\
         [[source]]\nname = \"alpha\"\nvalue = 4\nu = 1\n[[source]]\nname = \"b\"\nu = 1\n"
    );
    refusal(&text, &Evidence::default())
}

#[test]
fn an_expanded_uncertainty_without_k_or_p_is_refused() {
    let said =
        "line 5, `source`: `U` needs its coverage factor `k`, or its probability `p` with `dof`";
    assert_eq!(source("U = \"2 mN\""), said);
    assert_eq!(source("U = \"2 mN\"\nk = 2\np = 0.95"), said);
}

#[test]
fn a_unit_of_another_quantity_is_refused() {
    assert_eq!(
        source("u = \"2 mm\""),
        "line 6, `u`: `2 mm` is found, expected an amount in N or a unit of the same quantity"
    );
    assert!(source("u = 2").contains("expected an amount in N"));
    assert!(source("u = \"2 furlong\"").contains("unknown unit `furlong`"));
    assert!(source("half_width = \"1 N\"\nenters = \"cosine\"").contains("expected an angle"));
    assert!(source("half_width = \"1 N\"\nenters = \"relative\"").contains("expected a share"));
}

#[test]
fn an_amount_that_would_be_converted_to_another_unit_than_the_results_is_refused() {
    let text = |unit: &str| {
        format!(
            "budget_version = 1\nmeasurand = \"l\"\nunit = \"{unit}\"\nexpression = \"2 * x\"\n[[source]]\nname = \"x\"\nvalue = \"25 nm\"\nu = \"5 nm\"\n"
        )
    };
    let said = refusal(&text("nm"), &Evidence::default());
    assert!(
        said.starts_with(
            "line 8, `u`: `5 nm` is found, expected a number in the unit of the expression"
        ),
        "{said}"
    );
    let said = refusal(&text("deg"), &Evidence::default());
    assert_eq!(
        said,
        "line 2, `unit`: angles of an `expression` are in radians; state `unit = \"rad\"`"
    );
    let budget = budgets(&text("mm")).remove(0);
    assert_eq!((budget.value, budget.unit.as_str()), (5e-5, "mm"));
}

#[test]
fn a_unit_that_is_not_the_channels_is_refused() {
    let text = |measurand: &str, unit: &str| {
        format!(
            "budget_version = 1\nmeasurand = \"{measurand}\"\nunit = \"{unit}\"\nat = [\"1 N\"]\n"
        )
    };
    let said = refusal(&text("Fz", "mN"), &Evidence::default());
    assert_eq!(
        said,
        "line 2, `unit`: `mN` is found, expected N, the unit of Fz"
    );
    let said = refusal(&text("force", "mN"), &Evidence::default());
    assert!(
        said.starts_with("line 2, `unit`: the unit `mN` needs an `expression`"),
        "{said}"
    );
}

#[test]
fn negative_and_infinite_uncertainties_are_refused() {
    assert_eq!(
        source("u = \"-2 mN\""),
        "line 6, `u`: `-0.002` is found, expected 0 or more"
    );
    for number in ["nan", "inf"] {
        assert!(
            source(&format!("half_width = \"{number} mN\"")).contains("expected a finite number")
        );
    }
    assert!(source("half_width = \"-1 mN\"").contains("expected 0 or more"));
}

#[test]
fn degrees_of_freedom_of_zero_are_refused() {
    for dof in ["0", "-3", "nan"] {
        let said = source(&format!("u = \"1 mN\"\ndof = {dof}"));
        assert!(
            said.starts_with("line 7, `dof`")
                && said.ends_with("expected a number above 0, or inf"),
            "{said}"
        );
    }
}

#[test]
fn a_coverage_outside_0_to_1_is_refused() {
    for coverage in ["0", "1", "95", "nan"] {
        let text = format!(
            "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\ncoverage = {coverage}\n"
        );
        let said = refusal(&text, &Evidence::default());
        assert!(
            said.starts_with("line 4, `coverage`: ")
                && said.ends_with("expected a number between 0 and 1"),
            "{said}"
        );
    }
    assert!(source("U = \"1 mN\"\np = 1.5").starts_with("line 7, `p`"));
}

/// Error message for three sources with the correlation tables `rest`.
fn correlations(rest: &str) -> String {
    let mut text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n".to_owned();
    for name in ["one", "two", "three"] {
        text.push_str(&format!("[[source]]\nname = \"{name}\"\nu = \"1 mN\"\n"));
    }
    refusal(&format!("{text}{rest}"), &Evidence::default())
}

fn pair(one: &str, other: &str, r: &str) -> String {
    format!("[[correlation]]\nbetween = [\"{one}\", \"{other}\"]\nr = {r}\n")
}

#[test]
fn correlations_that_contradict_each_other_are_refused_with_the_eigenvalue() {
    let all = [
        pair("one", "two", "0.9"),
        pair("two", "three", "0.9"),
        pair("one", "three", "-0.9"),
    ]
    .concat();
    // 1 − 2 · 0.9.
    assert_eq!(
        correlations(&all),
        "line 14, `correlation`: the correlations contradict each other: the least eigenvalue of their matrix is -8.000e-1, expected 0 or more"
    );
}

#[test]
fn a_correlation_beyond_1_is_refused() {
    assert_eq!(
        correlations(&pair("one", "two", "1.1")),
        "line 15, `r`: `1.1` is found, expected a number from -1 to 1, or \"unknown\""
    );
}

#[test]
fn a_correlation_with_an_unknown_source_names_the_nearest_one() {
    assert_eq!(
        correlations(&pair("one", "tow", "0.1")),
        "line 14, `between`: `tow` is not a source; did you mean `two`?"
    );
    assert!(correlations(&pair("one", "one", "0.1")).contains("expected two different sources"));
    let twice = [pair("one", "two", "0.1"), pair("two", "one", "0.1")].concat();
    assert!(correlations(&twice).contains("is used twice, here and in line 14"));
}

/// Error message for a budget with a certificate, at 60 N.
fn certified(certificate: Certificate) -> String {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"60 N\"]\n[[source]]\nname = \"a\"\nfrom = \"certificate\"\n";
    refusal(text, &Evidence::default().with_certificate(certificate))
}

fn certificate() -> Certificate {
    let mut certificate = Certificate::new("D-K-1", "a laboratory", "42", Coverage::Factor(2.0));
    certificate.absolute = 0.003;
    certificate
}

#[test]
fn a_value_outside_the_certificates_range_is_refused() {
    let mut narrow = certificate();
    narrow.range = Some([0.05, 50.0]);
    assert_eq!(
        certified(narrow),
        "line 6, `from`: 60 N is outside the certificate's range, 0.05 to 50 N"
    );
}

#[test]
fn a_certificate_of_another_serial_is_refused() {
    let mut other = certificate();
    other.instrument_serial = Some("43".to_owned());
    assert_eq!(
        certified(other),
        "line 6, `from`: the certificate is for serial number `42`, but the instrument has `43`"
    );
}

#[test]
fn an_expired_certificate_is_warned_of_in_every_output() {
    let mut old = certificate();
    (old.valid_until, old.recorded_on) =
        (Some("2027-05-12".to_owned()), Some("2027-05-13".to_owned()));
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"6 N\"]\n[[source]]\nname = \"a\"\nfrom = \"certificate\"\n";
    let text = BudgetText::parse(text).expect("a budget");
    let budget = text
        .budgets(&Evidence::default().with_certificate(old), None)
        .expect("values")
        .remove(0);
    let said =
        "certificate D-K-1 was valid until 2027-05-12, but the recording was made on 2027-05-13";
    assert_eq!(budget.warnings, [said]);
    assert!(budget.to_string().contains(said));
    assert!(serde_json::to_string(&budget).expect("JSON").contains(said));
    assert_eq!(budget.traceability.expect("a certificate").number, "D-K-1");
}

#[test]
fn two_sources_of_one_name_are_refused_with_both_lines() {
    let said = source("u = \"1 mN\"\n[[source]]\nname = \"a\"\nu = \"1 mN\"");
    assert_eq!(
        said,
        "line 8, `name`: `a` is used twice, here and in line 5"
    );
}

#[test]
fn an_unknown_figure_names_the_nearest_one() {
    assert_eq!(
        figures("eror.within", "error.between"),
        "line 6, `from`: `eror.within` is not a measured figure here; did you mean `error.within`?"
    );
    assert!(source("from = \"certificate\"").contains("has no certificate"));
    assert!(source("from = \"drift\"").contains("is not a measured figure here"));
}

#[test]
fn an_expression_with_an_unknown_name_has_its_column() {
    assert_eq!(
        expression("2 * (alhpa + b)"),
        "line 4, `expression`: column 6: `alhpa` is not a source; did you mean `alpha`?"
    );
}

#[test]
fn a_division_by_zero_at_the_estimates_has_its_column() {
    assert_eq!(
        expression("1 + alpha / b"),
        "line 4, `expression`: column 11: division by 0 at the estimates"
    );
    assert!(expression("b ^ -1").contains("column 3: 0 to a negative power"));
}

#[test]
fn the_root_of_a_negative_number_has_its_column() {
    assert_eq!(
        expression("b + sqrt(1 - alpha)"),
        "line 4, `expression`: column 5: root of a negative number"
    );
    assert!(expression("ln(b)").contains("column 1: logarithm"));
    assert!(expression("sqrt(b)").contains("has no derivative"));
    assert!(expression("(1 - alpha) ^ 0.5").contains("column 13"));
    assert!(expression("exp(1000 * alpha)").contains("no finite value"));
}

#[test]
fn expressions_that_cannot_be_read_have_their_column() {
    for (text, said) in [
        ("alpha +", "column 8: the end is found"),
        ("(alpha", "column 7: expected `)`"),
        ("alpha b", "column 7: `b` is found, expected an operator"),
        ("sin alpha", "column 5: expected `(`"),
        ("1.2.3", "is not a number"),
        ("alpha $ b", "column 7: `$` is found"),
        ("", "column 1: the end is found"),
    ] {
        let found = expression(text);
        assert!(found.contains(said), "{text}: {found}");
    }
    let deep = "(".repeat(100_000);
    assert!(expression(&deep).contains("nested deeper than 100"));
    assert!(expression(&"-".repeat(100_000)).contains("nested deeper than 100"));
}

#[test]
fn a_half_width_of_zero_is_kept_and_no_uncertainty_divides_nothing() {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"a\"\nhalf_width = \"0 mN\"\n";
    let budget = budgets(text).remove(0);
    assert_eq!(
        (budget.u, budget.expanded, budget.k),
        (0.0, Some(0.0), None)
    );
    assert_eq!(
        budget.nu_eff.to_string(),
        "undefined: no source has an uncertainty"
    );
    assert_eq!(budget.sources[0].share, None);
    assert_eq!(budget.interval, Some([1.0, 1.0]));
    let some = budgets(&format!("{text}[[source]]\nname = \"b\"\nu = \"2 mN\"\n")).remove(0);
    assert_eq!((some.sources[0].u, some.sources[0].share), (0.0, Some(0.0)));
}

#[test]
fn unknown_keys_and_missing_ones_are_said_with_their_line() {
    let said = source("half_widht = \"1 mN\"");
    assert!(
        said.starts_with(
            "line 6: `half_widht`: unknown key, did you mean `half_width`?; known here: name, from"
        ),
        "{said}"
    );
    assert!(source("k = 2").contains("needs exactly one of `from`, `u`"));
    assert!(
        source("u = \"1 mN\"\nbeta = 0.5")
            .contains("the key `beta` belongs to `shape = \"trapezoid\"`")
    );
    let said = "the key `enters` belongs to `u`, `U`, `s` or `half_width`";
    assert!(source("from = \"error.within\"\nenters = \"relative\"").contains(said));
    assert!(
        source("half_width = \"1 mN\"\nshape = \"square\"").contains("`square` is not a shape")
    );
    let said = refusal(
        "budget_version = 1\nmeasurand = \"Fy\"\n",
        &Evidence::default(),
    );
    assert_eq!(
        said,
        "line 2, `at`: the key `at` is missing, such as `at = [\"1 N\"]`"
    );
    let said = refusal(
        "budget_version = 1\nmeasurand = \"Fzz\"\n",
        &Evidence::default(),
    );
    assert!(
        said.contains("`Fzz` is not a channel, so the key `unit` is needed; did you mean `Fz`?"),
        "{said}"
    );
}
