//! Bad files of sources and certificates: refused with file, line and key.

use super::{FORMATS, of_force};
use crate::support::Bench;

/// Budget file with one source `a`, whose further keys are on line 6 and below.
fn source(keys: &str) -> String {
    of_force(&format!("[[source]]\nname = \"a\"\n{keys}\n"))
}

/// Budget file with three sources, and the text `rest` from line 13 on.
fn correlated(rest: &str) -> String {
    let three = ["one", "two", "three"];
    let three = three.map(|name| format!("[[source]]\nname = \"{name}\"\nu = \"1 mN\"\n"));
    of_force(&format!("{}{rest}", three.concat()))
}

fn pair(one: &str, other: &str, r: &str) -> String {
    format!("[[correlation]]\nbetween = [\"{one}\", \"{other}\"]\nr = {r}\n")
}

/// Budget file with the expression `text` of two sources: alpha is 4, b is 0.
fn expression(text: &str) -> String {
    format!(
        "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"{text}\"\n\
         [[source]]\nname = \"alpha\"\nvalue = 4\nu = 1\n[[source]]\nname = \"b\"\nu = 1\n"
    )
}

#[test]
fn every_kind_of_bad_source_is_refused_by_its_line_and_key() {
    let contradicting = [
        pair("one", "two", "0.9"),
        pair("two", "three", "0.9"),
        pair("one", "three", "-0.9"),
    ];
    let same = "u = \"1 mN\"\n[[source]]\nname = \"a\"\nu = \"1 mN\"";
    let twice = "from = \"error\"\n[[source]]\nname = \"b\"\nfrom = \"repeatability\"";
    let rows = [
        (
            source("U = \"2 mN\""),
            "line 5, `source`: `U` needs its coverage factor `k`",
        ),
        (
            source("u = \"2 mm\""),
            "line 6, `u`: `2 mm` is found, expected an amount in N",
        ),
        (
            source("u = \"-2 mN\""),
            "line 6, `u`: `-0.002` is found, expected 0 or more",
        ),
        (source("half_width = \"nan mN\""), "line 6, `half_width`: "),
        (source("u = \"inf mN\""), "line 6, `u`: "),
        (
            source("u = \"1 mN\"\ndof = 0"),
            "line 7, `dof`: `0` is found, expected a number above 0",
        ),
        (source("U = \"1 mN\"\np = 1.5"), "line 7, `p`: "),
        (
            source(same),
            "line 8, `name`: `a` is used twice, here and in line 5",
        ),
        (
            source(twice),
            "line 6, `from`: `error` is not measured here: no result is given; add --results",
        ),
        (
            source("half_widht = \"1 mN\""),
            "line 6: `half_widht`: unknown key, did you mean `half_width`?",
        ),
        (
            of_force("coverage = 95\n"),
            "line 4, `coverage`: `95` is found, expected a number between 0 and 1",
        ),
        (
            correlated(&contradicting.concat()),
            "line 14, `correlation`: the correlations contradict each other: the least eigenvalue",
        ),
        (
            correlated(&pair("one", "two", "1.1")),
            "line 15, `r`: `1.1` is found, expected a number from -1 to 1",
        ),
        (
            correlated(&pair("one", "tow", "0.1")),
            "line 14, `between`: `tow` is not a source; did you mean `two`?",
        ),
        (
            expression("2 * (alhpa + b)"),
            "line 4, `expression`: column 6: `alhpa` is not a source; did you mean `alpha`?",
        ),
        (
            expression("1 + alpha / b"),
            "line 4, `expression`: column 11: division by 0 at the estimates",
        ),
        (
            expression("b + sqrt(1 - alpha)"),
            "line 4, `expression`: column 5: root of a negative number",
        ),
    ];
    let bench = Bench::new();
    for (text, message) in rows {
        bench.write("budget.toml", &text);
        bench.refused("budget budget.toml", 3, &format!("budget.toml: {message}"));
    }
}

#[test]
fn a_figure_inside_another_one_is_refused_with_both_lines() {
    let bench = super::evaluated();
    let inner = "from = \"error\"\n[[source]]\nname = \"b\"\nfrom = \"error.between\"";
    bench.write("budget.toml", &source(inner));
    bench.refused(
        "budget budget.toml --results r.json",
        3,
        "budget.toml: line 8, `from`: `error.between` is inside `error` (line 5); remove one of them",
    );
    bench.write("budget.toml", &source("from = \"drift\"\nhours = 8"));
    bench.refused(
        "budget budget.toml --results r.json",
        3,
        "budget.toml: line 6, `from`: `drift` is not measured here: ",
    );
}

#[test]
fn a_reading_outside_the_labels_of_the_samples_is_named_in_every_format() {
    let bench = super::evaluated();
    bench.write("budget.toml", &source("from = \"error.within\""));
    let words = "budget budget.toml --results r.json --mc 0";
    let budget = bench.json(words);
    let labels = super::source(&budget, "a")["labels"].clone();
    let [low, high] = [0, 1_usize].map(|end| super::number(&labels[end]));
    assert!(low < high && high < 50.0, "{labels}");
    let [first, second] = [0.25, 0.75].map(|share| low + share * (high - low));
    for format in FORMATS {
        let far = bench.ok(&format!("{words} --at 50N --format {format}"));
        let warning = "50 N is outside the labels of the samples, ";
        assert!(far.contains(warning), "{format}: {far}");
        let near = bench.ok(&format!("{words} --at {first:.6}N --format {format}"));
        assert!(!near.contains("outside the labels"), "{format}: {near}");
    }
    let text = bench.ok(&format!("{words} --at {first:.6}N,{second:.6}N"));
    let note = "Errors are pooled over samples with labels from ";
    assert_eq!(text.matches(note).count(), 1, "{text}");
}

#[test]
fn sources_without_an_uncertainty_have_none_and_divide_nothing() {
    let bench = Bench::new();
    bench.write("budget.toml", &source("half_width = \"0 mN\""));
    let text = bench.ok("budget budget.toml");
    assert!(text.contains("U = 0 N (no k"), "{text}");
    assert!(text.contains("no source has an uncertainty"), "{text}");
    let budget = bench.json("budget budget.toml");
    crate::schema::check("budget", &budget);
    assert_eq!(budget["U"], 0.0);
}

#[test]
fn a_file_without_a_source_has_no_uncertainty_of_zero() {
    let bench = Bench::new();
    bench.write("budget.toml", &of_force(""));
    bench.refused(
        "budget budget.toml",
        3,
        "budget.toml: no `[[source]]`, expected one or more",
    );
}

pub(super) const CERTIFICATE: &str = r#"number = "D-K-1"
laboratory = "a laboratory"
issued = 2026-05-12
valid_until = 2027-05-12
serial = "42"
k = 2.0
U = { Fz = "3.0 mN" }
range = { Fz = ["0.05 N", "50 N"] }
"#;

/// Test folder with `cert.toml`, a certificate below the table head `head`, and `budget.toml`, whose only source is that certificate.
fn certified(head: &str) -> Bench {
    let bench = Bench::new();
    bench.write("cert.toml", &format!("{head}{CERTIFICATE}"));
    bench.write("budget.toml", &source("from = \"certificate\""));
    bench
}

#[test]
fn a_certificate_gives_the_uncertainty_of_the_reference_and_its_number() {
    let words = "budget budget.toml --certificate cert.toml --date 2027-01-02 --mc 0";
    for head in [
        "",
        "[force.certificate]\n",
        "[[traceability]]\ninstrument = \"force\"\n[traceability.certificate]\n",
    ] {
        let budget = certified(head).json(words);
        crate::schema::check("budget", &budget);
        super::near(super::number(&budget["u"]), 0.0015, 1e-12);
        assert_eq!(budget["traceability"]["number"], "D-K-1");
        assert_eq!(budget["warnings"].as_array().expect("a list").len(), 0);
    }
}

#[test]
fn a_result_gives_the_certificate_of_its_recordings_unless_it_has_two_or_holds_for_some_alone() {
    let bench = certified("");
    let stated = |number: &str| {
        format!(
            r#"{{"instrument": "force", "serial": "42", "certificate": {{"number": "{number}", "laboratory": "L", "issued": "2026-05-12", "serial": "42", "k": 2.0, "U": {{"Fz": "3.0 mN"}}}}}}"#
        )
    };
    let result = |all: &str| {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "drawn", "source": "recorded"}}, "metrics": {{}}, "provenance": {{"traceability": [{all}]}}}}"#
        );
        taceva_files::seal::json::seal(&text).expect("JSON")
    };
    bench.write("r.json", &result(&stated("D-K-1")));
    let budget = bench.json("budget budget.toml --results r.json --mc 0");
    super::near(super::number(&budget["u"]), 0.0015, 1e-12);
    assert_eq!(budget["traceability"]["number"], "D-K-1");
    let both = [stated("D-K-1"), stated("D-K-2")].join(", ");
    bench.write("r.json", &result(&both));
    bench.refused(
        "budget budget.toml --results r.json",
        3,
        "line 6, `from`: `certificate` is not measured here: the recordings have several certificates",
    );
    let in_part = [stated("D-K-1").as_str(), r#"{"instrument": "force"}"#].join(", ");
    bench.write("r.json", &result(&in_part));
    bench.refused(
        "budget budget.toml --results r.json",
        3,
        "line 6, `from`: `certificate` is not measured here: some of the recordings have no certificate",
    );
    bench.ok("budget budget.toml --results r.json --certificate cert.toml --mc 0");
}

#[test]
fn the_day_of_a_result_is_that_on_which_a_certificate_must_be_valid() {
    let bench = certified("");
    let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "drawn", "source": "recorded"}, "metrics": {}, "provenance": {"recorded_on": "2027-06-01"}}"#;
    let sealed = taceva_files::seal::json::seal(result).expect("JSON");
    bench.write("r.json", &sealed);
    let words = "budget budget.toml --results r.json --certificate cert.toml --mc 0";
    let late = bench.ok(words);
    assert!(late.contains("was made on 2027-06-01"), "{late}");
    let stated = bench.ok(&format!("{words} --date 2027-01-02"));
    assert!(!stated.contains("was valid until"), "{stated}");
}

#[test]
fn a_certificate_that_does_not_hold_is_refused_and_an_expired_one_is_named_in_every_format() {
    let bench = certified("[force.certificate]\n");
    let words = "budget budget.toml --certificate cert.toml --mc 0";
    bench.refused(
        "budget budget.toml",
        3,
        "budget.toml: line 6, `from`: `certificate` is not measured here: the recording has no certificate; add --certificate",
    );
    bench.refused(
        &format!("{words} --at 60N"),
        3,
        "budget.toml: line 6, `from`: 60 N is outside the certificate's range, 0.05 to 50 N",
    );
    for format in FORMATS {
        let late = bench.ok(&format!("{words} --date 2027-06-01 --format {format}"));
        let warning = "certificate D-K-1 was valid until 2027-05-12, but the recording was made on 2027-06-01";
        assert!(late.contains(warning), "{format}: {late}");
    }
    let text = bench.ok(words);
    assert!(
        text.contains("the day of the recording is unknown"),
        "{text}"
    );
    let limited = format!("{words} --most-U 1N");
    let late = bench.ok(&format!("{limited} --date 2027-06-01 --html page.html"));
    let verdict =
        "U is at most 1.000 N for the sources named here; certificate expired. Compared: ";
    let certificate = "Certificate D-K-1 of a laboratory, serial 42, valid until 2027-05-12.";
    let page = std::fs::read_to_string(bench.path("page.html")).expect("there");
    for written in [&late, &page] {
        for words in [verdict, certificate] {
            assert!(written.contains(words), "no `{words}` in {written}");
        }
    }
    let valid = bench.ok(&format!("{limited} --date 2027-01-02"));
    assert!(
        valid.contains("U is at most 1.000 N. Compared: "),
        "{valid}"
    );
    assert!(
        valid.contains("Reading 0.5 N, correction 0 N, u = 0.001500 N."),
        "{valid}"
    );
    bench.write(
        "cert.toml",
        &format!(
            "[force.certificate]\n{}",
            CERTIFICATE.replace("k = 2.0\n", "")
        ),
    );
    bench.refused(words, 3, "`U` is stated without its coverage");
    bench.write(
        "cert.toml",
        "[force.certificate]\nnumber = \"1\"\nlaboratry = \"L\"\n",
    );
    bench.refused(words, 3, "cert.toml: line 3");
    bench.write("cert.toml", &CERTIFICATE.replace("Fz", "Fx"));
    bench.refused(
        words,
        3,
        "cert.toml: `certificate`: no certificate of a reference states `U`",
    );
    let other =
        "[[traceability]]\ninstrument = \"force\"\nserial = \"43\"\n[traceability.certificate]\n";
    bench.write("cert.toml", &format!("{other}{CERTIFICATE}"));
    bench.refused(
        words,
        3,
        "budget.toml: line 6, `from`: the certificate is for serial number `42`, but the instrument has `43`",
    );
}
