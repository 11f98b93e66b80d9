//! Tests common to all renderers.

use maud::Markup;

use super::*;
use crate::html::Document;

#[test]
fn every_format_escapes_what_it_would_obey() {
    let mut table = Table::new("a|b <i> $", ["name", "n"]);
    table.push(["=cmd\u{1b}[2J&", "3"]);
    assert!(table.text().contains("=cmd\\u{1b}[2J&  3"));
    assert!(table.csv().contains("'=cmd"));
    assert!(table.markdown().contains("=cmd\\[2J&amp; | 3"));
    assert!(table.latex(Layout::Float).contains("=cmd[2J\\& & 3"));
    let mut page = Document::new("", Markup::default());
    page.section("table", "Table", table.html());
    let escaped = "=cmd\u{fffd}[2J&amp;</td><td class=\"r\">3</td>";
    assert!(page.finish().contains(escaped));
}

#[test]
fn people_see_a_sign_and_programs_a_word() {
    let mut table = Table::new(
        "Scores",
        [Column::new("n"), Column::of_metrics(), Column::new("value")],
    );
    for metric in ["mae", "own", "r2"] {
        table.push(["1", metric, "0.5"]);
    }
    for form in [table.text(), table.markdown(), table.html().into()] {
        assert!(form.contains("mae ↓") && form.contains("r2 ↑"), "{form}");
        assert!(!form.contains("own ") || !form.contains("own ↓"), "{form}");
    }
    assert!(table.latex(Layout::Float).contains("mae $\\downarrow$"));
    let csv = "n,metric,better,value\n1,mae,lower,0.5\n1,own,,0.5\n1,r2,higher,0.5\n";
    assert_eq!(table.csv(), csv);
    assert!(table.json("x").contains("\"better\": \"higher\""));
}

#[test]
fn heads_have_signs_for_people_alone() {
    let error = Column::new("MAE Fz").unit("N");
    let error = error.direction(Direction::Is(Better::Lower));
    let mut table = Table::new("Models", [Column::new("model"), error]);
    table.push(["ridge", "0.1"]);
    assert!(table.text().contains("MAE Fz (N) ↓"));
    assert_eq!(table.csv(), "model,MAE Fz (N)\nridge,0.1\n");
}

#[test]
fn a_table_without_rows_keeps_its_columns() {
    let table = Table::new("", [Column::of_metrics(), Column::new("value")]);
    assert_eq!(table.csv(), "metric,better,value\n");
    assert_eq!(table.markdown(), "| metric | value |\n|---|---|\n");
    assert_eq!(table.text(), "metric  value\n");
    assert_eq!(table.text_within(40), "");
}

#[test]
fn words_that_look_like_numbers_stay_words() {
    let mut table = Table::new("", ["name", "n"]);
    table.push([Cell::text("-5"), Cell::from("-5")]);
    assert_eq!(table.csv(), "name,n\n'-5,-5\n");
    assert_eq!(table.markdown(), "| name | n |\n|---|---:|\n| -5 | -5 |\n");
}

#[test]
fn a_rounded_p_value_keeps_all_its_digits_for_programs() {
    let mut table = Table::new("", ["p"]);
    table.push([Cell::p_value(Some(0.000_123_4))]);
    assert_eq!(table.text(), "      p\n< 0.001\n");
    assert_eq!(table.csv(), "p\n0.0001234\n");
    assert!(table.json("x").contains("\"p\": \"0.0001234\""));
    let page = table.html_fragment();
    assert!(page.contains("data-v=\"0.0001234\""), "{page}");
}

#[test]
fn each_number_of_a_mixed_column_stands_to_the_right_where_it_says_so() {
    let by_cell = Column::new("value").align(Align::ByCell);
    let mut table = Table::new("", [Column::new("metric"), by_cell]);
    table.push(["mae", "0.25"]);
    table.push(["own", "–"]);
    assert_eq!(table.text(), "metric  value\nmae      0.25\nown     –\n");
}

#[test]
fn an_estimate_is_a_phrase_or_two_lines_of_a_paper() {
    let estimate = |number: f64, is_best: bool| {
        Cell::Estimate(Estimate {
            formatted: crate::FormattedValue::number(number, Some([number - 0.2, number + 0.2])),
            unit: "N".to_owned(),
            remark: (!is_best).then(|| "no skill".to_owned()),
            is_best,
            mark: "",
        })
    };
    let value = Column::new("value").align(Align::Right);
    let mut table = Table::new("", [Column::new("metric"), value]);
    table.push([Cell::text("mae"), estimate(0.5, true)]);
    table.push([Cell::text("mae"), estimate(0.7, false)]);
    let markdown = table.markdown();
    assert!(
        markdown.contains("| **0.50** (0.30 … 0.70) N |"),
        "{markdown}"
    );
    let latex = table.latex(Layout::Rows);
    assert_eq!(
        latex,
        "% needs \\usepackage{booktabs}\n\\begin{tabular}{lr}\n  \\toprule\n  metric & value \\\\\n  \\midrule\n  \
         mae & \\textbf{0.50}\\,N \\\\\n   & \\scriptsize [0.30, 0.70] \\\\\n  \
         mae & 0.70\\,N \\\\\n   & \\scriptsize [0.50, 0.90], no skill \\\\\n  \\bottomrule\n\\end{tabular}\n"
    );
    assert!(table.text().contains("0.70 N (0.50 … 0.90), no skill"));
}
